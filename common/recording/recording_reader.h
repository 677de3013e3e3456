// A recording, event by event: the sessions in it, their bones and their state frames.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/recording/pcap_file.h"
#include "common/wire/session_receiver.h"

namespace osteomill {

struct RecordedEvent {
    PacketPlace place;
    Stamp stamp;
    std::size_t bytes = 0;  ///< size of the frame
    SessionEvent event;
};

class RecordingReader {
  public:
    /// Throws RecordingError as PacketReader does.
    explicit RecordingReader(std::filesystem::path file) : packets_(std::move(file)) {}

    /// The next frame's event, or nothing at the end. A hello begins another session, whatever was before:
    /// recordings may be joined. Throws RecordingError, with packet and byte, for a frame that is corrupt,
    /// out of order, of another time than its packet's, or of another major version of the protocol.
    std::optional<RecordedEvent> next();

    /// At the end: whether the file ends within a packet.
    bool is_truncated() const { return packets_.is_truncated(); }

    /// Behind a state frame, to come back to within the same session.
    struct Mark {
        PacketPlace place;
        std::uint64_t sequence = 0;
    };
    Mark mark() const { return {packets_.place(), receiver_.last_sequence()}; }
    void go_back_to(const Mark& mark);

    /// For a frame that the bone contradicts.
    RecordingError error_at(const PacketPlace& place, const std::string& what) const {
        return RecordingError(packets_.where(place) + what);
    }

  private:
    PacketReader packets_;
    SessionReceiver receiver_;
};

// The time of a recording: seconds since its first frame. If recordings were joined, each session follows the
// one before at once, whenever it was recorded.

class RecordedTime {
  public:
    /// The next frame's time; never earlier than the one before.
    double next_s(Stamp stamp, bool begins_session) {
        if (begins_session || !session_began_) {
            session_began_ = stamp;
            session_begins_s_ = last_s_;
        }
        const std::chrono::duration<double> since = stamp - *session_began_;
        last_s_ = std::max(last_s_, session_begins_s_ + since.count());
        return last_s_;
    }
    double last_s() const { return last_s_; }

  private:
    std::optional<Stamp> session_began_;
    double session_begins_s_ = 0.0;
    double last_s_ = 0.0;
};

/// The outline of a recording: its duration, and the moments worth seeing.
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
