// Watchdog: detects the conditions that must turn the force off. It only reports; force_guard.h acts.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "simulation/device/haptic_device.h"
#include "simulation/safety/fault.h"

namespace osteomill {

/// Whether bone reaches into the burr.
enum class Clearance : std::uint8_t { clear, in_bone, unknown };

/// The facts that the haptic loop knows at a tick.
struct Observation {
    double now_s = 0.0;                      ///< session time
    DeviceState device;                      ///< as just read
    std::uint64_t model_step = 0;            ///< the newest milling result's; 0: none yet
    bool model_valid = true;                 ///< that result is one
    std::uint64_t missed_periods = 0;        ///< haptic deadlines that passed unserved just before this tick
    double energy_to_hand_mj = 0.0;          ///< net, lately (energy_meter.h)
    bool holds_still = false;                ///< the session is paused, bone restored or the tool placed
    Clearance clearance = Clearance::clear;  ///< the burr's, were it where the hand is
};

/// Finds every fault of a tick, each by itself. Bone in the burr is not among them (safety_monitor.h):
///   device_lost     the device is not connected, or reads values that are not finite
///   device_jumped   it moved farther than a hand can since the last tick
///   model_stalled   no new milling result for longest_model_age_s
///   not_a_number    the milling result is not valid
///   energy_to_hand  the force gave the hand more than most_energy_to_hand_mj lately
///   paused          the session is to hold still
///   overrun         longest_overrun_s of deadlines missed with no tick in time between them
class Watchdog {
  public:
    /// No fresh model result for 50 ms.
    static constexpr double longest_model_age_s = 0.05;
    /// Twice as fast as a hand in surgery ever moves, with a margin of an encoder step or two.
    static constexpr double fastest_hand_mm_per_s = 2000.0;
    static constexpr double jump_allowance_mm = 1.0;
    /// A force older than this no longer answers the hand's motion.
    static constexpr double longest_overrun_s = 0.02;

    /// Net within EnergyMeter::window_s. The coupling's spring, drawn to the force of the device, holds 4 mJ.
    static constexpr double most_energy_to_hand_mj = 15.0;

    explicit Watchdog(double tick_s) : tick_s_(tick_s) {}

    /// Once a tick. Real-time safe.
    FaultSet check(const Observation& seen) noexcept;

  private:
    double tick_s_;
    std::uint64_t model_step_ = 0;
    double model_changed_s_ = 0.0;
    std::uint64_t overrun_periods_ = 0;
    bool has_position_ = false;
    glm::dvec3 position_mm_{0.0};
    double position_s_ = 0.0;
};

}  // namespace osteomill
