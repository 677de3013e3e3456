// The protocol with a haptic arm that is plugged in: its reports' bytes, one by one, which ArmConversation
// (hid_arm.cpp) carries: wakes it up, has it calibrated, keeps only its newest reading, and lets a force
// through only when that is safe.
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

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_transport.h"
#include "devices/position_sensor.h"
#include "simulation/device/fade_out.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

/// The reports that haptic arms of the WoodenHaptics and Polhem family exchange over USB HID. They are not
/// numbered; every field is a little-endian int16.
///
///   first generation, 8 bytes     in   counts a b c, debug
///                                 out  currents a b c (mA), debug
///   second generation, 14 bytes   in   counts a b c (arm), d e f (stylus), info
///                                 out  currents a b c (mA), command, attributes 0 1 2
///
/// The switch on the stylus is coded into count d: 10 000 is added while it is pressed. info 1 asks to be
/// calibrated and stays until that is done. Command 0 drives the motors; command 1 sets the counters, a b c
/// from the attributes, d e f from the current fields.
enum class ArmGeneration { first, second };

constexpr std::size_t report_bytes(ArmGeneration generation) {
    return generation == ArmGeneration::first ? 8 : 14;
}

struct ArmInput {
    ArmGeneration generation = ArmGeneration::second;
    std::array<int, 3> arm_counts{};     ///< a, b, c, as the device has them
    std::array<int, 3> stylus_counts{};  ///< d, e, f, without the switch
    bool is_switch_pressed = false;
    bool asks_for_calibration = false;
};

/// The generation shows in the length. Nothing for a report of another length, or with an info that is
/// neither 0 nor 1. Real-time safe.
std::optional<ArmInput> decode_arm_report(std::span<const std::uint8_t> report) noexcept;

/// The bytes for hidapi: a zero byte for "not numbered", then the report.
struct ArmOutput {
    std::array<std::uint8_t, 15> storage{};
    std::size_t size = 0;

    std::span<const std::uint8_t> bytes() const { return {storage.data(), size}; }
};

/// No current leaves this file that is larger: the amplifiers' 2 A.
inline constexpr int most_current_ma = 1999;

/// Drives the motors a, b, c; each current is capped at +-most_current_ma. Real-time safe.
ArmOutput currents_report(ArmGeneration generation, const std::array<int, 3>& currents_ma) noexcept;

/// Second generation only: sets the counters of the arm, and those of the stylus to zero. Counts beyond an
/// int16 are capped. The motors are without current. Real-time safe.
ArmOutput counters_report(const std::array<int, 3>& arm_counts) noexcept;

/// Meaning of the one switch on a stylus: the pedal, or, if the profile lets it, the clutch. Pressed it is
/// the pedal. Pressed twice within double_press_s and held it is the clutch, until it is let go.
class StylusSwitch {
  public:
    /// From the first press to the second; a pedal that is let go and pressed again is slower.
    static constexpr double double_press_s = 0.3;

    explicit StylusSwitch(SwitchUse use) : use_(use) {}

    /// `now_s` never decreases. Real-time safe.
    void read(bool is_pressed, double now_s) noexcept {
        const bool goes_down = is_pressed && !was_pressed_;
        if (goes_down && use_ == SwitchUse::pedal_and_clutch)
            is_clutch_ = has_been_pressed_ && now_s - pressed_s_ <= double_press_s;
        if (goes_down) {
            pressed_s_ = now_s;
            has_been_pressed_ = true;
        }
        if (!is_pressed) is_clutch_ = false;
        was_pressed_ = is_pressed;
    }

    bool is_pedal() const { return was_pressed_ && !is_clutch_; }
    bool is_clutch() const { return is_clutch_; }

  private:
    SwitchUse use_;
    bool was_pressed_ = false;
    bool has_been_pressed_ = false;
    bool is_clutch_ = false;
    double pressed_s_ = 0.0;
};

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
    FadeOut sent_force_;
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
