// What a session measured, as JSON. The keys are fixed by the design; others may join them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/scene/scene.h"
#include "haptic_server/loop/milling_session.h"
#include "haptic_server/program/server_options.h"

namespace osteomill {

nlohmann::ordered_json measurements(const MillingSessionReport& report, const Scene& scene,
                                    const ServerOptions& options);

/// Throws std::runtime_error with one line naming the file.
void write_json(const nlohmann::ordered_json& json, const std::filesystem::path& file);

}  // namespace osteomill
