// Measurements of a session, as JSON. Programs of others read the keys: none goes or changes its meaning;
// others may join them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/recording/recording_writer.h"
#include "common/scene/scene.h"
#include "common/session/structure_watch.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

/// The bone's cost before the first tick.
struct BoneCost {
    std::size_t memory_bytes = 0;  ///< the milling loop's bone: see memory_bytes()
    double bone_mm3 = 0.0;
    double startup_s = 0.0;  ///< from the program's start until the session could begin and clients connect
};

/// `peak_resident_bytes` counts the whole program, with the streaming loop's copy of the bone.
nlohmann::ordered_json session_json(const MillingSessionReport& report, const BoneCost& bone,
                                    std::uint64_t peak_resident_bytes, const Scene& scene,
                                    const MillingSessionOptions& options);

/// The histograms behind the percentiles, by loop. Each is a list of pairs: a duration in microseconds, and
/// how many ticks lasted at most that long and longer than the pair before.
nlohmann::ordered_json histograms_us(const MillingSessionReport& report);

/// Adds the results for each protected structure, as "structures", and the memory to watch them, as
/// "structures_memory_bytes"; nothing if there are no structures.
void add_structures(nlohmann::ordered_json& json, const StructureWatch& structures, const Scene& scene);

/// The outcome of a recording, under "recording": file, frames, bytes, pauses (while the disk was full),
/// error (null if there is none).
nlohmann::ordered_json recorded(const RecordingReport& recording);

/// Replaces the file as a whole. Throws std::runtime_error with one line naming the file.
void write_json(const nlohmann::ordered_json& json, const std::filesystem::path& file);

/// The most bytes that were resident at once: VmHWM of the text of /proc/self/status; std::nullopt if it
/// has none. (getrusage would also count the resident memory of the program that started this one.)
std::optional<std::uint64_t> peak_resident_bytes(std::istream& status);

}  // namespace osteomill
