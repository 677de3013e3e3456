// Outputs of a session: the bone, logs, the recording, measurements and a report.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/program/program_output.h"
#include "haptic_server/program/measurements.h"
#include "haptic_server/session/session_assembly.h"

namespace osteomill {

struct OutputFiles {
    std::optional<std::filesystem::path> save_bone{};
    std::optional<std::filesystem::path> json{};
    std::optional<std::filesystem::path> json_histograms{};  ///< beside json
    std::optional<std::filesystem::path> report{};           ///< folder; the recording lies in it
    std::string report_language = "en";                      ///< one of languages()
    std::optional<std::filesystem::path> case_folder{};      ///< where the tool's place is remembered
};

/// Once the session has run: writes everything although one of them fails, ends streaming, and throws the
/// first failure as std::runtime_error. `settings`: those of session_settings; `peak_bytes`: the program's
/// peak memory.
void write_outputs(SessionAssembly& assembly, const OutputFiles& files, const BoneCost& cost,
                   std::uint64_t peak_bytes, const nlohmann::ordered_json& settings,
                   const ProgramOutput& output);

}  // namespace osteomill
