// A running session's figures in Prometheus' text format 0.0.4
// (https://prometheus.io/docs/instrumenting/exposition_formats/). Names and units: docs/operating.md.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/session/tick_sample.h"
#include "haptic_server/streaming/streaming_server.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/exchange/triple_buffer.h"
#include "simulation/safety/fault.h"

namespace osteomill {

/// Timing of the haptic loop while it runs: counted from the ticks that the loop hands to its logs, so that
/// the loop itself knows nothing of it.
///
/// The loop's thread pushes, one other reads.
class TickMeter final : public SampleLog<TickSample> {
  public:
    /// Upper bounds, s; the last bucket has none. A tick is late for the hand from 1 ms on.
    static constexpr std::array latency_bounds_s{5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4,
                                                 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 5e-2};

    struct Reading {
        double session_s = 0.0;
        std::uint64_t ticks = 0;
        std::uint64_t missed_deadlines = 0;  ///< periods that no tick came for: gaps in the ticks' times
        /// From when a tick was due to when its force was on its way to the device and its work done; how
        /// many ticks by bucket. None on the virtual clock.
        std::array<std::uint64_t, latency_bounds_s.size() + 1> latency{};
        double latency_sum_s = 0.0;
        std::array<std::uint64_t, all_faults.size() + 1> faults{};  ///< how often each began; index = Fault
        Fault fault = Fault::none;                                  ///< now
        double force_n = 0.0;
        double removed_mm3 = 0.0;
        bool spindle_on = false;
        std::uint64_t spindle_starts = 0;
    };

    void begin() override { begin(std::chrono::steady_clock::now()); }
    void begin(std::chrono::steady_clock::time_point now) { began_ = now; }
    void push(const TickSample& tick) noexcept override { push(tick, std::chrono::steady_clock::now()); }
    void push(const TickSample& tick, std::chrono::steady_clock::time_point done) noexcept;
    void drain() override {}
    void drain_all() override {}

    /// The newest tick's reading. To be called by one thread only.
    Reading read() noexcept {
        readings_.refresh();
        return readings_.front();
    }

  private:
    Reading now_;  // the loop's
    TripleBuffer<Reading> readings_;
    std::optional<std::chrono::steady_clock::time_point> began_{};  // time zero; none on the virtual clock
};

std::string prometheus_text(const TickMeter::Reading& loop, const StreamingTraffic& traffic,
                            const std::string& version);

}  // namespace osteomill
