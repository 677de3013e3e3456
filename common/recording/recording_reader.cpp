#include "common/recording/recording_reader.h"

#include <string>
#include <utility>

#include "common/wire/sealed_frame.h"

namespace osteomill {

std::optional<RecordedEvent> RecordingReader::next() {
    const std::optional<Packet> packet = packets_.next();
    if (!packet) return std::nullopt;
    auto frame = open_frame(packet->message, Seal::required);
    if (const auto* error = std::get_if<WireError>(&frame)) throw error_at(packet->place, error->line);
    if (std::get<v1::ServerFrame>(frame).has_hello())
        receiver_ = {};
    else if (packet->place.number == 1)
        throw error_at(packet->place, "a recording begins with a hello, this one's beginning was cut off");
    if (const auto error = check_time(std::get<v1::ServerFrame>(frame), packet->stamp))
        throw error_at(packet->place, error->line);
    auto event = receiver_.take(std::get<v1::ServerFrame>(std::move(frame)));
    if (const auto* error = std::get_if<WireError>(&event)) throw error_at(packet->place, error->line);
    if (const auto* other = std::get_if<SpeaksOtherProtocol>(&std::get<SessionEvent>(event)))
        throw error_at(packet->place,
                       "recorded with protocol " + std::to_string(other->major) + ", this program reads " +
                           std::to_string(protocol_major) + ": use " +
                           (other->major > protocol_major ? "a newer" : "an older") + " version of it");
    return RecordedEvent{packet->place, packet->stamp, packet->message.size(),
                         std::get<SessionEvent>(std::move(event))};
}

std::optional<WireError> RecordingReader::check_time(const v1::ServerFrame& frame, Stamp stamp) {
    if (frame.has_hello()) frames_have_time_ = frame.has_recorded_unix_ns();
    if (frame.has_recorded_unix_ns() != frames_have_time_)
        return WireError{frames_have_time_ ? "the frame lacks its time"
                                           : "the frame has a time, others have none"};
    if (frames_have_time_ && frame.recorded_unix_ns() != stamp.time_since_epoch().count())
        return WireError{"its time stamp is not the one that was recorded: damaged, or moved by a tool"};
    return std::nullopt;
}

void RecordingReader::go_back_to(const Mark& mark) {
    packets_.seek(mark.place);
    receiver_.go_on_behind(mark.sequence);
}

}  // namespace osteomill
