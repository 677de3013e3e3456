// Times at which a server's spindle turned, by the server's own session time, and the session time of an
// event outside. So a test of "off within so many milliseconds" needs only that the server's own ticks come,
// however busy the machine is.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <vector>

#include "common/session/tool_state.h"
#include "tests/support/force_log_file.h"

namespace osteomill::testing {

/// The session's time by the wall clock of this machine, learnt from the server's state frames.
class SessionClock {
  public:
    void note(const ToolState& tool) {
        if (tool.taken_unix_ns == 0 || tool.time_s <= 0.0) return;
        // A tool is up to a tick old when it is taken, never younger.
        began_s_ = std::min(began_s_, 1e-9 * static_cast<double>(tool.taken_unix_ns) - tool.time_s);
    }
    double now_s() const {
        const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
        return std::chrono::duration<double>(since_1970).count() - began_s_;
    }

  private:
    double began_s_ = std::numeric_limits<double>::infinity();
};

/// How long after `event_s` the spindle turned last before it stood still; nothing if it did not turn then
/// or did not stop.
inline std::optional<double> spindle_off_after_s(const std::vector<ForceLogLine>& log, double event_s) {
    const auto after = [&](double time_s) {
        return std::ranges::lower_bound(log, time_s, {}, &ForceLogLine::time_s);
    };
    const auto at = after(event_s);
    if (at == log.end() || !at->spindle_on) return std::nullopt;
    const auto off =
        std::find_if(at, log.end(), [](const ForceLogLine& sample) { return !sample.spindle_on; });
    if (off == log.end()) return std::nullopt;
    return off->time_s - event_s;
}

/// For how long it stood between two moments.
inline double spindle_stood_s(const std::vector<ForceLogLine>& log, double from_s, double to_s) {
    double stood_s = 0.0;
    for (std::size_t i = 1; i < log.size(); ++i)
        if (log[i].time_s > from_s && log[i].time_s < to_s && !log[i].spindle_on)
            stood_s += log[i].time_s - log[i - 1].time_s;
    return stood_s;
}

}  // namespace osteomill::testing
