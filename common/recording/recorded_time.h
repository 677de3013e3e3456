// The time of a recording: seconds since its first frame. If recordings were joined, each session follows the
// one before at once, whenever it was recorded.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "common/recording/packet.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// Whether a packet has the time that its frame states. Frames are sealed, packets are not: if the two
/// differ, the recording was damaged or moved in time.
inline bool has_time_of(const v2::ServerFrame& frame, const Packet& packet) {
    return frame.has_recorded_unix_ns() &&
           frame.recorded_unix_ns() == packet.stamp.time_since_epoch().count();
}

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

}  // namespace osteomill
