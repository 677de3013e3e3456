#include "haptic_server/monitoring/tick_meter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "simulation/loop/milling_session.h"

namespace osteomill {

void TickMeter::push(const TickSample& tick, std::chrono::steady_clock::time_point done) noexcept {
    if (now_.ticks > 0) {
        const double periods = std::round((tick.time_s - now_.session_s) / MillingSession::tick_s);
        if (periods > 1.0) now_.missed_deadlines += static_cast<std::uint64_t>(periods) - 1;
    }
    now_.session_s = tick.time_s;
    ++now_.ticks;

    if (began_) {
        const double latency_s = std::chrono::duration<double>(done - *began_).count() - tick.time_s;
        const auto bound = std::lower_bound(latency_bounds_s.begin(), latency_bounds_s.end(), latency_s);
        ++now_.latency[static_cast<std::size_t>(bound - latency_bounds_s.begin())];
        now_.latency_sum_s += latency_s;
    }

    if (static_cast<Fault>(tick.fault) != now_.fault && tick.fault < now_.faults.size())
        ++now_.faults[tick.fault];
    now_.fault = static_cast<Fault>(tick.fault);
    if (tick.spindle_on && !now_.spindle_on) ++now_.spindle_starts;
    now_.spindle_on = tick.spindle_on;
    now_.force_n = glm::length(tick.force_n);
    now_.removed_mm3 = tick.removed_mm3;
    readings_.back() = now_;
    readings_.publish();
}

}  // namespace osteomill
