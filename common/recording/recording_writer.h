// Writer of a recording on a thread of its own (background_writer.h), for loops that must not wait for a
// disk.
//
// A full disk may have space later. A recorder that can send its news later treats it as a slow disk: it
// sends no more once the buffer is full, until there is space. So no frame is missing, and the file continues
// where it stopped. A recorder that cannot wait, because its frames come from elsewhere, ends the recording.
//
// Until the recording is complete it is the part beside the requested file (session_file.h). The part can be
// read at any time, and remains if the recording is torn.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/files/background_writer.h"
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

struct RecordedFrame {
    Stamp stamp;
    std::string message;

    std::size_t size() const { return message.size(); }
};

/// finish() leaves the part as it is.
class RecordingWriter final : public BackgroundWriter<RecordedFrame> {
  public:
    /// Between two attempts to go on. A full disk costs a system call in that time.
    static constexpr std::chrono::milliseconds retry_period{500};
    /// Limit of the data that wait for the disk: a second of the fastest loopback snapshot. A caller that
    /// finds it full sends its news later, as to a slow client.
    static constexpr std::size_t capacity_bytes = 8 * 1024 * 1024;

    /// Called on the writing thread, with one line for people; must not call the writer.
    using OnNews = std::function<void(RecordingNews, const std::string&)>;

    /// Begins the file; throws RecordingError.
    RecordingWriter(const std::filesystem::path& file, OnNews on_news, WhenDiskIsFull when_full);

    /// Takes the frame even beyond the capacity. Call only if has_room().
    void push(Stamp stamp, std::string message);
    /// Finishes first, and makes the part the file, unless frames are missing. Failures show in the report.
    void commit();
    /// Finishes first; the destructor then deletes the file: it is worthless.
    void discard();
    RecordingReport report() const;
    /// The new place of a recording that an earlier, killed session left under the part's name.
    const std::optional<std::filesystem::path>& torn() const;

  private:
    struct Part;
    explicit RecordingWriter(std::shared_ptr<Part> part);

    std::shared_ptr<Part> part_;
};

}  // namespace osteomill
