#include "common/recording/recording_reader.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "common/recording/recorded_time.h"
#include "common/wire/sealed_frame.h"

namespace osteomill {

std::optional<RecordedEvent> RecordingReader::next() {
    const std::optional<Packet> packet = packets_.next();
    if (!packet) return std::nullopt;
    auto frame = open_frame(packet->message);
    if (const auto* error = std::get_if<WireError>(&frame)) throw error_at(packet->place, error->line);
    if (std::get<v2::ServerFrame>(frame).has_hello())
        receiver_ = {};
    else if (packet->place.number == 1)
        throw error_at(packet->place, "a recording begins with a hello, this one's beginning was cut off");
    const bool has_its_time = has_time_of(std::get<v2::ServerFrame>(frame), *packet);
    auto event = receiver_.take(std::get<v2::ServerFrame>(std::move(frame)));
    if (const auto* error = std::get_if<WireError>(&event)) throw error_at(packet->place, error->line);
    if (const auto* other = std::get_if<SpeaksOtherProtocol>(&std::get<SessionEvent>(event)))
        throw error_at(
            packet->place,
            other->major > protocol_major
                ? fmt::format("recorded with protocol {}, this program reads {}: use Osteomill {} or later",
                              other->major, protocol_major, other->program_version)
                : fmt::format("recorded with protocol {}, this program reads {}: use Osteomill {} or earlier",
                              other->major, protocol_major, other->program_version));
    if (!has_its_time)
        throw error_at(packet->place,
                       "its time stamp is not the one that was recorded: damaged, or moved by a tool");
    return RecordedEvent{packet->place, packet->stamp, packet->message.size(),
                         std::get<SessionEvent>(std::move(event))};
}

void RecordingReader::go_back_to(const Mark& mark) {
    packets_.seek(mark.place);
    receiver_.go_on_behind(mark.sequence);
}

}  // namespace osteomill
