// The outline of a recording: its duration, and the moments worth seeing.
#pragma once

#include <filesystem>
#include <vector>

namespace osteomill {

struct RecordedMoment {
    enum class Kind {
        mark,   ///< that somebody set
        touch,  ///< a spell of touching a protected structure begins
    };
    double time_s = 0.0;  ///< since the first frame
    Kind kind = Kind::mark;

    bool operator==(const RecordedMoment&) const = default;
};

struct RecordingOutline {
    double duration_s = 0.0;                ///< from the first frame to the last that can be read
    std::vector<RecordedMoment> moments{};  ///< in their order
    bool has_view = false;                  ///< it states the operator's viewpoint
};

/// Reads all frames, but no bone. Throws RecordingError for a file that is no recording.
RecordingOutline outline_of(const std::filesystem::path& file);

}  // namespace osteomill
