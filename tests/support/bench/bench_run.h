// A run of the bench: a device and a hand, moved in fine substeps, under a force that is set once a tick from
// a sensed position; with the imperfections of a real device, each of which can be switched off.
//
// The order within a tick: the sensor is read, the force law answers, its answer waits in the delay line, the
// motors give what their limit allows until the next tick.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tests/support/bench/held_body.h"

namespace osteomill::testing {

/// From the position sensed at a tick, metres, to the force on the device until the next, newtons.
using ForceLaw = std::function<double(double sensed_position_m)>;

struct Bench {
    HeldBody body;
    double tick_s = 1e-3;
    int substeps = 100;                ///< per tick: 10 us at 1 kHz
    double sensor_resolution_m = 0.0;  ///< 0: the position is read exactly
    double max_force_n = 0.0;          ///< the motors'; 0: no limit
    std::size_t delay_ticks = 0;       ///< from a reading to its force
};

struct BenchTick {
    MotionState state{};      ///< at the tick
    double force_n = 0.0;     ///< that the motors give from here to the next
    double farthest_m = 0.0;  ///< largest |x| from here to the next
    double taken_j = 0.0;     ///< energy that the forces took until the next tick: - sum u dx
};

/// Runs from `start` for so many ticks, or until the motion is past `give_up_m`.
std::vector<BenchTick> run_bench(const Bench& bench, ForceLaw law, const MotionState& start,
                                 std::size_t ticks, double give_up_m = 1e3);

/// A push: 1 mm/s from rest.
inline constexpr MotionState push{.position_m = 0.0, .velocity_m_per_s = 1e-3};

/// The tick of a part of a run, not empty, in which |x| is largest.
std::span<const BenchTick>::iterator farthest(std::span<const BenchTick> run);

/// The rate, 1/s, at which the swing grew: from the farthest point of the run's second third to the farthest
/// of its last, which should each be several swings long. +infinity for a run that was given up before
/// `ticks_asked`, -infinity for one that ended at the origin.
double growth_per_s(const std::vector<BenchTick>& run, double tick_s, std::size_t ticks_asked);

}  // namespace osteomill::testing
