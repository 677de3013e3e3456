// The protocol with a haptic arm that is plugged in, report by report, which ArmConversation (hid_arm.cpp)
// carries: wakes it up, has it calibrated, keeps only its newest reading, and lets a force through only when
// that is safe.
//
//             first report           calibrated          a small force is wanted
//   waking ----------------> uncalibrated ----> waiting <------------------------> driving
//                                 ^                |  silent, clutch, no fresh force  |
//                                 +----------------+--- the calibration switch -------+
//   any --- unplugged, or given_up_after_s without a report ---> gone
//
//   waking        silent: it is sent zero currents every wake_after_s. The motors are without current in all
//                 states but `driving`
//   uncalibrated  its counters mean nothing. An arm with a calibration switch asks; its counters are set to
//                 the profile's, and it is calibrated once it reads so. An arm that is calibrated at power-up
//                 passes on at once
//   waiting       it reads positions; output is enabled once a force of at most small_force_n is wanted, so
//                 that the hand is never met by one that was there before it
//   driving       every report is answered by the currents of the newest force
//   gone          for good: the owner of the connection closes it and looks for the device again
//
// A report of another length than the first, or that means nothing, is counted and passed over.
#pragma once

#include <cstdint>
#include <optional>

#include "devices/clutch.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"
#include "devices/hid/arm_report.h"
#include "devices/hid/hid_transport.h"
#include "devices/hid/stylus_switch.h"
#include "devices/position_sensor.h"
#include "simulation/device/fading_force.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

class ArmLink {
  public:
    enum class State { waking, uncalibrated, waiting, driving, gone };

    /// The device answers one report per report: if nothing comes for this long, it waits for ours.
    static constexpr double wake_after_s = 0.010;
    /// Two exchanges that failed: the arm's last report is then too old to answer with a force.
    static constexpr double silent_after_s = 0.020;
    static constexpr double given_up_after_s = 0.5;
    /// A force that has not been renewed for this long ends.
    static constexpr double longest_force_age_s = 0.020;
    static constexpr double small_force_n = 0.1;
    /// How far a hand that holds the arm at its calibration position may move it meanwhile.
    static constexpr int calibration_tolerance_counts = 100;

    /// The connection outlives the link, which begins at `now_s`.
    ArmLink(const ArmProfile& profile, HidConnection& connection, double now_s);
    /// Leaves the motors without current.
    ~ArmLink();
    ArmLink(const ArmLink&) = delete;
    ArmLink& operator=(const ArmLink&) = delete;

    /// At `now_s` (never decreases), waits up to `wait_ms` for a report and keeps the newest of those that
    /// are there. Allocates nothing.
    void receive(int wait_ms, double now_s) noexcept;

    /// Reads the received report, at `now_s` (never decreases), and answers the device. `wanted_n`: the force
    /// on the hand, device space, if there is a fresh one. Allocates nothing.
    void answer(double now_s, const std::optional<glm::dvec3>& wanted_n) noexcept;

    State state() const { return state_; }
    /// Newest reading; `connected` only in `waiting` and `driving`, while reports come. Its pedal is as of
    /// the time, on the clock of `now_s`, when the queue of reports was last empty before it.
    const DeviceState& reading() const { return reading_; }
    /// A notice for people, a text with static lifetime; empty while all is well.
    const char* notice() const noexcept;
    /// Reports that were passed over.
    std::uint64_t malformed_count() const { return malformed_count_; }

  private:
    void take_over(const ArmInput& input, double now_s) noexcept;
    void calibrate(const ArmInput& input) noexcept;
    void read_position(const ArmInput& input, double now_s) noexcept;
    void consider_output(double now_s, const std::optional<glm::dvec3>& wanted_n) noexcept;
    void send(double now_s) noexcept;
    std::array<int, 3> counts_of(const ArmInput& input) const noexcept;

    ArmProfile profile_;
    ArmKinematics kinematics_;
    HidConnection& connection_;
    State state_ = State::waking;
    ArmGeneration generation_ = ArmGeneration::second;
    std::optional<ArmInput> received_;  // not yet taken over
    double empty_s_;                    // no report was waiting then
    double received_s_ = 0.0;           // the newest came after that
    FadingForce sent_force_;
    bool is_gone_ = false;
    bool is_calibrating_ = false;
    std::uint64_t malformed_count_ = 0;

    StylusSwitch switch_;
    Clutch clutch_;
    PositionSensor sensor_{0.0};
    DeviceState reading_{.connected = false};
    glm::dvec3 angles_rad_{0.0};

    bool is_answer_due_ = false;
    double report_s_;  // time of the newest report
    double sent_s_;    // time of our last report
    double wanted_s_;  // time of the newest force
    bool has_force_ = false;
    glm::dvec3 wanted_n_{0.0};
};

}  // namespace osteomill
