#include "common/recording/recording_outline.h"

#include <cstdint>
#include <utility>

#include "common/recording/packet_reader.h"
#include "common/recording/recorded_time.h"
#include "common/wire/sealed_frame.h"

namespace osteomill {

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
