// Guard of a measurement: it lets a force through while the pedal is held, the arm is there and every bound
// holds. After the first thing that is wrong the force is zero, for good, from that very tick.
//
//   waiting --the pedal is pressed--> open --pedal up, arm lost, too far, too much energy ...--> shut
//
// A force is bounded in size and in its change; the energy that the hand got lately is bounded as in any
// session (safety/watchdog.h), and the change as in safety/force_guard.h.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "simulation/device/haptic_device.h"
#include "simulation/safety/energy_meter.h"
#include "simulation/safety/pedal_latch.h"

namespace osteomill {

/// Why a measurement ended.
enum class MeasuringEnd : std::uint8_t {
    none,
    done,
    pedal_up,
    arm_lost,
    not_finite,
    late,        ///< the loop stood still
    moved_away,  ///< the hand, by farthest_mm
    energy,
};

/// In words, as the rest of a sentence "the measurement ended: ...".
const char* text_of(MeasuringEnd end);

class MeasuringGuard {
  public:
    static constexpr double most_force_n = 2.5;
    /// A share of the force that the arm can give for long.
    static constexpr double share_of_force = 0.8;
    static constexpr double slew_n_per_s = 1000.0;
    static constexpr double most_energy_mj = 15.0;
    static constexpr double farthest_mm = 4.0;
    static constexpr double longest_gap_s = 0.02;
    /// Further in a tick is a jump, not a hand.
    static constexpr double longest_step_mm = 5.0;

    explicit MeasuringGuard(double arm_force_n)
        : force_bound_n_(arm_force_n * share_of_force < most_force_n ? arm_force_n * share_of_force
                                                                     : most_force_n) {}

    /// Begins a tick at `now_s`, which is later than the last one's. Real-time safe, as all here.
    void look(const DeviceState& arm, double now_s) noexcept;
    /// Ends it: the force that may be written.
    glm::dvec3 pass(const glm::dvec3& wanted_n) noexcept;

    /// For the next part of a measurement: it opens anew while the pedal stays down, and ends if it does not.
    MeasuringGuard again() const noexcept {
        MeasuringGuard next = *this;
        next.end_ = pedal_.is_pressed() ? MeasuringEnd::none : MeasuringEnd::pedal_up;
        next.is_open_ = false;
        return next;
    }

    bool is_open() const noexcept { return is_open_ && end_ == MeasuringEnd::none; }
    MeasuringEnd end() const noexcept { return end_; }
    /// Ends it for that reason, unless it has ended before.
    void shut(MeasuringEnd why) noexcept {
        if (end_ == MeasuringEnd::none) end_ = why;
    }
    /// The place from which farthest_mm counts.
    void stay_near(const glm::dvec3& place_mm) noexcept { place_mm_ = place_mm; }
    /// Ticks that were missed before this one.
    std::size_t missed() const noexcept { return missed_; }
    double force_bound_n() const noexcept { return force_bound_n_; }

  private:
    double force_bound_n_;
    PedalDate pedal_date_;
    PedalLatch pedal_;
    EnergyMeter energy_;
    bool is_open_ = false;
    MeasuringEnd end_ = MeasuringEnd::none;
    bool has_looked_ = false;
    double looked_s_ = 0.0;
    double elapsed_s_ = 0.0;
    std::size_t missed_ = 0;
    glm::dvec3 place_mm_{0.0};
    glm::dvec3 force_n_{0.0};  // of the last tick
};

}  // namespace osteomill
