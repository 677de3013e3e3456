// Time of a packet against the time that its frame states. Frames are sealed, packets are not: if the two
// differ, the recording was damaged or moved in time.
#pragma once

#include "common/recording/packet.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

inline bool has_time_of(const v2::ServerFrame& frame, const Packet& packet) {
    return frame.has_recorded_unix_ns() &&
           frame.recorded_unix_ns() == packet.stamp.time_since_epoch().count();
}

}  // namespace osteomill
