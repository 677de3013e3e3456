// A recorded session, computed again from its recording alone: the scene and the bone that it began with, the
// hand of every tick, and on the real clock the order in which the loops took turns.
//
// A row of the recording is a tick. All its numbers are compared, as they are written, with those of the same
// tick computed again; and after every state the checksum of the bone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace osteomill {

struct RepeatedSession {
    std::uint64_t ticks = 0;   ///< that were compared
    std::uint64_t states = 0;  ///< whose bone was compared
    bool is_equal = false;     ///< all of them, to the bit
    /// If they differ: the first tick that does.
    std::optional<std::uint64_t> tick{};
    double time_s = 0.0;
    std::string difference{};  ///< which number, as recorded and as computed; or why it cannot be repeated

    /// One line for people.
    std::string line() const;
};

/// Throws RecordingError if the file is no recording. `on_progress`: 0 to 1, now and then; if it throws, the
/// repetition ends.
RepeatedSession repeat_session(const std::filesystem::path& file,
                               const std::function<void(double)>& on_progress);

}  // namespace osteomill
