// Contents of a recording in numbers, as packet_replay --info says them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/recording/playhead.h"

namespace osteomill {

struct RecordingSummary : RecordingCounts {
    SessionInfo session;  ///< the last, where recordings were joined
    Grid grid;
    std::uint64_t sessions = 0;
    double duration_s = 0.0;
    std::map<std::string, double> milled_s{};       ///< by burr: how long it turned
    double removed_mm3 = 0.0;                       ///< since the recording began
    std::map<std::string, double> by_tissue_mm3{};  ///< the parts of that; by the scene's names, "unlabelled"
                                                    ///< the rest
    std::uint64_t bone_checksum = 0;                ///< the remaining bone's
    bool has_goodbye = false;                       ///< the session ended before the recording did
    bool is_truncated = false;                      ///< the file ends within a packet
    std::string error{};                            ///< why it is not read further; empty at the end
};

/// Reads a recording through, every checksum with it; `on_state` is called behind each state frame. Throws
/// RecordingError if there is no bone in it; later faults are reported in `error`.
RecordingSummary summarise(const std::filesystem::path& file,
                           const std::function<void(const Playhead&)>& on_state);

/// Keys: duration_s, frames, protocol, bone_checksum (16 hex digits), removed_mm3 {total, and one per tissue
/// name}, and other known values.
nlohmann::ordered_json to_json(const RecordingSummary& summary);

/// The same for people, in lines.
std::string to_text(const RecordingSummary& summary);

}  // namespace osteomill
