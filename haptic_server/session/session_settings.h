// Settings of a session, by name: in --json under "settings", and in the hello of every client and
// recording.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "devices/simulated/hand_model.h"
#include "haptic_server/session/session_scene.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

/// Keys: version, scene, force_model, coupling, device, grip (of a simulated hand, or rails), burr (at the
/// start), rpm, haptic_rate_hz, milling_rate_hz, clock, vibration; and bone, trajectory where the choice has
/// a file: its name. A session has no seed: nothing in it is drawn at random.
nlohmann::ordered_json session_settings(const MillingSessionOptions& milling, const SceneChoice& choice,
                                        const Scene& scene, const std::string& device,
                                        std::optional<Grip> grip, const std::string& version);

std::map<std::string, std::string> as_texts(const nlohmann::ordered_json& settings);

}  // namespace osteomill
