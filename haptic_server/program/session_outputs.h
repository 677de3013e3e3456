// Outputs of a session: the bone, logs, the recording, measurements and a report.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/files/output_place.h"
#include "common/log/line_stream.h"
#include "haptic_server/program/session_json.h"
#include "haptic_server/session/session_assembly.h"

namespace osteomill {

// The folder of a session's report: the files that a session leaves there, and the rule that no two share
// one.

/// The path of the recording of the session that is reported in `folder`.
std::filesystem::path recording_in(const std::filesystem::path& folder);

/// Makes the folder. Throws std::runtime_error with one line if it cannot be made, or holds a session
/// already.
void prepare_report_folder(const std::filesystem::path& folder);

struct OutputFiles {
    std::optional<std::filesystem::path> save_bone{};
    std::optional<std::filesystem::path> json{};
    std::optional<std::filesystem::path> json_histograms{};  ///< beside json
    std::optional<std::filesystem::path> report{};           ///< folder; the recording lies in it
    std::string report_language = "en";                      ///< one of languages()
    std::optional<std::filesystem::path> case_folder{};      ///< where the tool's place is remembered
};

/// Places of the files that a session writes when it has ended: each reserved for it, and watched meanwhile.
class EndPlaces {
  public:
    /// Throws as OutputPlace does.
    explicit EndPlaces(const OutputFiles& files);

    /// Null: no bone is saved.
    const OutputPlace* save_bone() const { return save_bone_ ? &*save_bone_ : nullptr; }
    /// The paths to write them to now.
    OutputFiles now() const;

    /// Twice a second.
    bool check_is_due() const { return std::chrono::steady_clock::now() >= next_check_; }
    /// A line for each thing that has gone wrong since the last call: a folder is gone, or the bone's file
    /// has changed since it was loaded.
    std::vector<std::string> check(const BoneSource& source);

  private:
    OutputFiles files_;
    std::optional<OutputPlace> save_bone_{};
    std::optional<OutputPlace> json_{};
    std::optional<OutputPlace> histograms_{};
    std::optional<OutputPlace> report_{};  ///< reserved, so that a list of sessions sees that it comes
    std::chrono::steady_clock::time_point next_check_{};
    bool source_is_lost_ = false;
};

/// Once the session has run: writes everything although one of them fails, ends streaming, and throws the
/// first failure as std::runtime_error. `settings`: those of session_settings; `peak_bytes`: the program's
/// peak memory.
void write_outputs(SessionAssembly& assembly, const OutputFiles& files, const BoneCost& cost,
                   std::uint64_t peak_bytes, const nlohmann::ordered_json& settings,
                   const ProgramOutput& output);

}  // namespace osteomill
