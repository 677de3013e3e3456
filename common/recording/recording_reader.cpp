#include "common/recording/recording_reader.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "common/recording/pcap_file.h"
#include "common/wire/sealed_frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

namespace {

/// Whether a packet has the time that its frame states. Frames are sealed, packets are not: if the two
/// differ, the recording was damaged or moved in time.
bool has_time_of(const v2::ServerFrame& frame, const Packet& packet) {
    return frame.has_recorded_unix_ns() &&
           frame.recorded_unix_ns() == packet.stamp.time_since_epoch().count();
}

}  // namespace

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

namespace {

std::uint64_t touches_so_far(const v2::StateFrame& state) {
    std::uint64_t touches = 0;
    for (const v2::StructureDistance& distance : state.distances()) touches += distance.touches_so_far();
    return touches;
}

}  // namespace

RecordingOutline outline_of(const std::filesystem::path& file) {
    using Kind = RecordedMoment::Kind;
    PacketReader packets(file);
    RecordedTime time;
    RecordingOutline outline;
    std::uint64_t touches = 0;
    try {
        while (const auto packet = packets.next()) {
            const auto opened = open_frame(packet->message);
            const auto* frame = std::get_if<v2::ServerFrame>(&opened);
            if (frame == nullptr || !has_time_of(*frame, *packet)) break;
            const double time_s = time.next_s(packet->stamp, frame->has_hello());
            if (frame->has_hello()) touches = 0;
            if (!frame->has_state()) continue;
            outline.has_view = outline.has_view || frame->state().has_view();
            for (const v2::SessionEvent& event : frame->state().events())
                if (event.action() == v2::SESSION_ACTION_MARK && !event.is_refused())
                    outline.moments.push_back({time_s, Kind::mark});
            const std::uint64_t before = std::exchange(touches, touches_so_far(frame->state()));
            if (touches > before) outline.moments.push_back({time_s, Kind::touch});
        }
    } catch (const RecordingError&) {
        // The reader of the recording meets the same error and reports it.
    }
    outline.duration_s = time.last_s();
    return outline;
}

}  // namespace osteomill
