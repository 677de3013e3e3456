// Writer of a recording on a thread of its own, for loops that must not wait for a disk.
//
// A full disk may have space later. A recorder that can send its news later treats it as a slow disk: the
// frame that did not fit is tried again at intervals, later frames wait, and once the buffer is full no more
// is accepted until there is space. So no frame is missing, and the file continues where it stopped. A
// recorder that cannot wait, because its frames come from elsewhere, ends the recording.
//
// A disk that does not answer at all (a pulled drive, a lost server, a pipe whose reader has stopped) holds
// up only that thread: callers wait a bounded time, then the recording is given up. The thread cannot be
// joined; it is abandoned, and touches only its own data until the program ends.
//
// Until the recording is complete it is the part beside the requested file (session_file.h). The part can be
// read at any time, and remains if the recording is torn.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "common/recording/pcap_file.h"

namespace osteomill {

/// The outcome of a recording.
struct RecordingReport {
    std::filesystem::path file;  ///< where it lies by now
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;
    std::uint64_t missed_ticks = 0;  ///< that should be in it; the disk could not keep up
    std::uint64_t pauses = 0;        ///< for which it stood still, and after which it went on
    std::string error{};             ///< one line; empty where all frames are in the file
};

/// One line about a recording that has ended with an error: the error, and where the frames written so far
/// can be read. Empty if all frames are in the file.
std::string ending_of(const RecordingReport& report);

/// News of a recording under way.
enum class RecordingNews {
    stands_still,  ///< nothing more can be written, for now or for good
    goes_on,       ///< again
};

/// The behaviour of a recording when nothing more can be written.
enum class WhenDiskIsFull {
    end,        ///< there: frames that come later are forgotten
    try_again,  ///< until it succeeds or the recording is closed
};

class RecordingWriter {
  public:
    /// Between two attempts to go on. A full disk costs a system call in that time.
    static constexpr std::chrono::milliseconds retry_period{500};
    /// How long the end waits for a disk that takes nothing,
    static constexpr std::chrono::seconds longest_standstill{2};
    /// and how long before the end, and until data in the system's memory reach the disk.
    static constexpr std::chrono::seconds longest_wait{30};

    /// Limit of the data that wait for the disk: a second of the fastest loopback snapshot. A caller that
    /// finds it full sends its news later, as to a slow client.
    static constexpr std::size_t capacity_bytes = 8 * 1024 * 1024;

    /// Called on the writing thread, with one line for people; must not call the writer.
    using OnNews = std::function<void(RecordingNews, const std::string&)>;

    /// Begins the file; throws RecordingError.
    RecordingWriter(const std::filesystem::path& file, OnNews on_news, WhenDiskIsFull when_full);
    /// Closes first, if need be. A recording that was not committed stays as a part, if anything is in it.
    ~RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    /// Whether push() would take a frame. After the end of the recording it accepts every frame, and drops
    /// it.
    bool has_room() const;
    /// Waits until there is space, or the disk is full: for callers that may wait for a disk. Gives the
    /// recording up once the disk has accepted nothing for so long.
    void wait_for_room(std::chrono::milliseconds longest = longest_wait);
    /// Waits until all that was pushed is in the file, or the disk is full; gives up alike.
    void wait_until_written(std::chrono::milliseconds longest = longest_wait);
    /// Never waits for the disk. Call only if has_room().
    void push(Stamp stamp, std::string message);
    /// Whether the last attempt to write has failed.
    bool has_failed() const;

    /// Writes the waiting frames, with one last attempt if the disk is full, and ends the thread; gives the
    /// recording up if the disk stands still. Later pushes are discarded.
    void close();
    /// Closes first, and makes the part the file, unless frames are missing. Failures show in the report.
    void commit();
    /// Closes first; the destructor then deletes the file: it is worthless.
    void discard();
    RecordingReport report() const;
    /// The new place of a recording that an earlier, killed session left under the part's name.
    const std::optional<std::filesystem::path>& torn() const;

  private:
    struct Shared;

    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

}  // namespace osteomill
