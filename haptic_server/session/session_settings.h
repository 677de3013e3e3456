// Settings of a session, by name: in --json under "settings", and in the hello of every client and
// recording. With the scene's text beside them they are all that a session computes from, but for the motion
// of its hand.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "devices/simulated/hand_and_arm.h"
#include "haptic_server/session/session_scene.h"
#include "simulation/device/haptic_device.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

/// The hand that moves the tool.
struct HandSettings {
    std::string device{};        ///< that it holds: a name of device_table.h, or "prescribed"
    std::optional<Grip> grip{};  ///< a simulated hand's grip; nothing: the tool is put where the input says
    DeviceLimits arm{};
};

/// The same for every session, however it is started; `scene` with its device placed (seated()). Keys:
/// version, commit, scene, force_model, coupling, device, grip (of a simulated hand; firm if a hand's pose is
/// prescribed, for no force moves it; or rails), burr (at the start), rpm, haptic_rate_hz, milling_rate_hz,
/// clock, vibration, wall_friction, start_position_mm, start_spindle_axis, bone_digest (of all of the bone at
/// the start), structures_digest, is_built_in, case_digest (of its case.toml; a built-in case has none), arm
/// (its limits), removed_before_mm3 (by sessions before), instruction_set, seeds (none: nothing in a session
/// is drawn at random); and bone, trajectory if the choice has a file: its name, and trajectory_digest.
nlohmann::ordered_json session_settings(const MillingSessionOptions& milling, const SceneChoice& choice,
                                        const SessionScene& scene, const HandSettings& hand,
                                        std::string_view version);

std::map<std::string, std::string> as_texts(const nlohmann::ordered_json& settings);

/// The scene that a session has after all changes, complete; it names only the last part of files' paths.
std::string effective_scene_text(Scene scene);

}  // namespace osteomill
