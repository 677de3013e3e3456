// A recording for a streaming server to show, at any speed, in place of a session that is going on.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/recording/playhead.h"
#include "haptic_server/streaming/stream_source.h"

namespace osteomill {

/// Shows one session, from where the playhead is to that session's end. It waits for its first viewer. Data
/// that cannot be read end it; see error().
class RecordedSession final : public StreamSource {
  public:
    using Clock = std::chrono::steady_clock;

    /// The mirror that update() is given must equal the playhead's bone. `speed`: recorded seconds a second.
    /// The playhead outlives it.
    RecordedSession(Playhead& playhead, double speed, std::function<Clock::time_point()> now)
        : playhead_(playhead), speed_(speed), now_(std::move(now)), begins_s_(playhead.time_s()) {}

    SessionState update(BoneReplica& mirror, std::size_t viewers) override;

    /// Any thread. Whether all was shown.
    bool is_over() const { return is_over_.load(); }
    /// Once it is over, after the server has been stopped: one line; empty if nothing was wrong.
    const std::string& error() const { return error_; }

  private:
    void show(BoneReplica& mirror, double until_s);

    Playhead& playhead_;
    const double speed_;
    const std::function<Clock::time_point()> now_;
    const double begins_s_;
    std::optional<Clock::time_point> began_;
    std::vector<ControlEvent> events_;  // from the frames that one update reads together
    std::string error_;
    std::atomic<bool> is_over_{false};
};

}  // namespace osteomill
