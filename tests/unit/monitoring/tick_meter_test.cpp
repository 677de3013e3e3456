#include <gtest/gtest.h>

#include <numeric>

#include "haptic_server/monitoring/prometheus_text.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;

const std::chrono::steady_clock::time_point began{1000s};

/// The tick of millisecond `ms`, done so much after it was due.
void push(TickMeter& meter, int ms, std::chrono::microseconds after, Fault fault = Fault::none,
          bool spindle_on = false) {
    meter.push({.time_s = 0.001 * ms,
                .force_n = {0.0, 3.0, 4.0},
                .removed_mm3 = 0.5,
                .spindle_on = spindle_on,
                .fault = static_cast<std::uint8_t>(fault)},
               began + std::chrono::milliseconds(ms) + after);
}

TEST(TickMeter, CountsTheMillisecondsThatNoTickCameFor) {
    TickMeter meter;
    for (const int ms : {0, 1, 2, 4, 5, 9, 10}) push(meter, ms, 20us);
    EXPECT_EQ(meter.read().ticks, 7U);
    EXPECT_EQ(meter.read().missed_deadlines, 1U + 3U);
    EXPECT_DOUBLE_EQ(meter.read().session_s, 0.010);
}

TEST(TickMeter, LatencyIsFromWhenATickWasDueToWhenItIsDone) {
    TickMeter meter;
    meter.begin(began);
    push(meter, 0, 3us);
    push(meter, 1, 30us);
    push(meter, 3, 150us);
    push(meter, 4, 1300us);
    push(meter, 6, 99000us);
    const TickMeter::Reading reading = meter.read();
    const auto in_bucket = [&](double up_to_s) {
        for (std::size_t i = 0; i < TickMeter::latency_bounds_s.size(); ++i)
            if (TickMeter::latency_bounds_s[i] == up_to_s) return reading.latency[i];
        return reading.latency.back();
    };
    for (const double bound_s : {5e-6, 5e-5, 2e-4, 2e-3, 1.0}) EXPECT_EQ(in_bucket(bound_s), 1U) << bound_s;
    EXPECT_EQ(std::accumulate(reading.latency.begin(), reading.latency.end(), 0ULL), 5U);
    EXPECT_NEAR(reading.latency_sum_s, 3e-6 + 30e-6 + 150e-6 + 1300e-6 + 99e-3, 1e-9);
}

TEST(TickMeter, KnowsNoLatencyOnTheVirtualClock) {
    TickMeter meter;
    push(meter, 0, 20us);
    push(meter, 1, 20us);
    const TickMeter::Reading reading = meter.read();
    EXPECT_EQ(reading.ticks, 2U);
    EXPECT_EQ(std::accumulate(reading.latency.begin(), reading.latency.end(), 0ULL), 0U);
}

TEST(TickMeter, CountsHowOftenAFaultBeganAndTheSpindleWasStarted) {
    TickMeter meter;
    push(meter, 0, 20us);
    for (int ms = 1; ms < 4; ++ms) push(meter, ms, 20us, Fault::overrun, true);
    push(meter, 4, 20us);
    push(meter, 5, 20us, Fault::overrun, true);
    push(meter, 6, 20us, Fault::device_lost, true);
    const TickMeter::Reading reading = meter.read();
    EXPECT_EQ(reading.faults[static_cast<std::size_t>(Fault::overrun)], 2U);
    EXPECT_EQ(reading.faults[static_cast<std::size_t>(Fault::device_lost)], 1U);
    EXPECT_EQ(reading.fault, Fault::device_lost);
    EXPECT_EQ(reading.spindle_starts, 2U);
    EXPECT_TRUE(reading.spindle_on);
    EXPECT_DOUBLE_EQ(reading.force_n, 5.0);
    EXPECT_DOUBLE_EQ(reading.removed_mm3, 0.5);
}

}  // namespace
}  // namespace osteomill
