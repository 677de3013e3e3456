// A recording, event by event: the sessions in it, their bones and their state frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/recording/packet_reader.h"
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

}  // namespace osteomill
