// A haptic arm of the second generation that is not there: its firmware, which counts, answers report by
// report and watches its host, and the arm itself in a hand. The other end of the HID driver in tests, in
// memory and in a virtual machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"

namespace osteomill::testing {

/// The angles A, B, C at which an arm's tip is at a position (device space, mm), elbow up; a place out of
/// reach gives angles that are not finite.
glm::dvec3 angles_at(const ArmProfile& profile, const glm::dvec3& position_mm);

/// Encoder counts, rounded, of bodies at these angles.
std::array<int, 3> counts_at(const ArmProfile& profile, const glm::dvec3& angles_rad);

class VirtualArm {
  public:
    /// The firmware cuts the motors this long after the last report.
    static constexpr double watchdog_s = 0.5;

    /// Powered up with the tip at the calibration position, counters at zero.
    explicit VirtualArm(const ArmProfile& profile);

    void move_to(const glm::dvec3& position_mm);
    void press_switch(bool is_pressed) { is_switch_pressed_ = is_pressed; }
    /// Somebody presses the switch on the board.
    void ask_for_calibration() { asks_ = true; }
    /// Restarts as after it was unplugged: all counters at zero wherever it is.
    void power_up();

    /// The report that it sends now: 14 bytes.
    std::array<std::uint8_t, 14> report() const;
    /// Receives the host's report, without the leading byte: 14 bytes, or it is ignored.
    void take(std::span<const std::uint8_t> report, double now_s);

    /// Force of the motors on the hand at the tip, device space.
    glm::dvec3 force_n(double now_s) const;
    const std::array<int, 3>& currents_ma() const { return currents_ma_; }
    std::uint64_t calibrations() const { return calibrations_; }

  private:
    ArmProfile profile_;
    ArmKinematics kinematics_;
    std::array<int, 3> counts_{};   // the bodies', from angle zero
    std::array<int, 3> offsets_{};  // counter = count + offset
    bool is_switch_pressed_ = false;
    bool asks_ = false;
    std::array<int, 3> currents_ma_{};
    double taken_s_ = 0.0;
    std::uint64_t calibrations_ = 0;
};

}  // namespace osteomill::testing
