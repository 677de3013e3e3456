#include "haptic_server/monitoring/tick_meter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "simulation/loop/milling_session.h"

namespace osteomill {

namespace {
constexpr auto relaxed = std::memory_order_relaxed;
}  // namespace

void TickMeter::push(const TickSample& tick, std::chrono::steady_clock::time_point done) noexcept {
    if (ticks_.load(relaxed) > 0) {
        const double periods = std::round((tick.time_s - session_s_.load(relaxed)) / MillingSession::tick_s);
        if (periods > 1.0) raise(missed_, static_cast<std::uint64_t>(periods) - 1);
    }
    session_s_.store(tick.time_s, relaxed);
    raise(ticks_);

    if (began_) {
        const double latency_s = std::chrono::duration<double>(done - *began_).count() - tick.time_s;
        const auto bound = std::lower_bound(latency_bounds_s.begin(), latency_bounds_s.end(), latency_s);
        raise(latency_[static_cast<std::size_t>(bound - latency_bounds_s.begin())]);
        latency_sum_s_.store(latency_sum_s_.load(relaxed) + latency_s, relaxed);
    }

    if (tick.fault != fault_.load(relaxed) && tick.fault < faults_.size()) raise(faults_[tick.fault]);
    fault_.store(tick.fault, relaxed);
    if (tick.spindle_on && !spindle_on_.load(relaxed)) raise(spindle_starts_);
    spindle_on_.store(tick.spindle_on, relaxed);
    force_n_.store(glm::length(tick.force_n), relaxed);
    removed_mm3_.store(tick.removed_mm3, relaxed);
}

TickMeter::Reading TickMeter::read() const {
    Reading reading{.session_s = session_s_.load(relaxed),
                    .ticks = ticks_.load(relaxed),
                    .missed_deadlines = missed_.load(relaxed),
                    .latency_sum_s = latency_sum_s_.load(relaxed),
                    .fault = static_cast<Fault>(fault_.load(relaxed)),
                    .force_n = force_n_.load(relaxed),
                    .removed_mm3 = removed_mm3_.load(relaxed),
                    .spindle_on = spindle_on_.load(relaxed),
                    .spindle_starts = spindle_starts_.load(relaxed)};
    for (std::size_t i = 0; i < latency_.size(); ++i) reading.latency[i] = latency_[i].load(relaxed);
    for (std::size_t i = 0; i < faults_.size(); ++i) reading.faults[i] = faults_[i].load(relaxed);
    return reading;
}

}  // namespace osteomill
