// An open recording: the values of its states, column by column, and its bone at any instant.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

#include "analysis/replay/recording_summary.h"
#include "common/recording/playhead.h"

namespace osteomill::python {

/// A value, or three, for each state.
struct StateColumns {
    std::vector<double> time_s, session_time_s;
    std::vector<double> hand_mm, burr_mm, axis, force_n;
    std::vector<double> depth_mm, removed_mm3;
    std::vector<std::uint8_t> burr, spindle_on;
};

/// All ticks of a recording that can be read.
std::vector<TickSample> ticks_of(const std::filesystem::path& file);

class OpenedRecording {
  public:
    /// Throws RecordingError if it holds no bone.
    explicit OpenedRecording(std::filesystem::path file)
        : file_(std::move(file)), playhead_(std::in_place, file_) {}

    const std::filesystem::path& file() const { return file_; }

    // One thread at a time: the caller of these holds `busy`.
    std::mutex& busy() { return busy_; }

    /// Reads the recording through, the first time.
    const StateColumns& columns() { return read(), columns_; }
    const RecordingSummary& summary() { return read(), *summary_; }

    /// The bone after the last frame that is no later than `time_s`, seconds since the recording began. Goes
    /// on from the last requested time, or begins anew if that is later. Throws RecordingError for a fault
    /// before that time.
    const Bone& bone_at(double time_s);

  private:
    void read();

    std::filesystem::path file_;
    std::mutex busy_;
    std::optional<Playhead> playhead_;
    StateColumns columns_;
    std::optional<RecordingSummary> summary_;
};

}  // namespace osteomill::python
