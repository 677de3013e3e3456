#include "devices/hid/arm_link.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>

namespace osteomill {

namespace {

/// The pressed switch adds the offset to count d, which is then above the threshold.
constexpr int switch_threshold = 5000;
constexpr int switch_offset = 10'000;

constexpr std::size_t info_field = 6;
constexpr std::size_t command_field = 3;
constexpr std::size_t first_attribute_field = 4;
constexpr int set_counters = 1;

int field(std::span<const std::uint8_t> report, std::size_t index) noexcept {
    const auto bits = static_cast<std::uint16_t>(report[2 * index] | report[2 * index + 1] << 8);
    return static_cast<std::int16_t>(bits);
}

void set_field(ArmOutput& output, std::size_t index, int value) noexcept {
    using Limits = std::numeric_limits<std::int16_t>;
    const int capped = std::clamp<int>(value, Limits::min(), Limits::max());
    const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(capped));
    output.storage[1 + 2 * index] = static_cast<std::uint8_t>(bits & 0xFF);
    output.storage[2 + 2 * index] = static_cast<std::uint8_t>(bits >> 8);
}

}  // namespace

std::optional<ArmInput> decode_arm_report(std::span<const std::uint8_t> report) noexcept {
    ArmInput input;
    if (report.size() == report_bytes(ArmGeneration::first)) {
        input.generation = ArmGeneration::first;
    } else if (report.size() != report_bytes(ArmGeneration::second)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < 3; ++i) input.arm_counts[i] = field(report, i);
    if (input.generation == ArmGeneration::first) return input;

    for (std::size_t i = 0; i < 3; ++i) input.stylus_counts[i] = field(report, 3 + i);
    if (input.stylus_counts[0] > switch_threshold) {
        input.stylus_counts[0] -= switch_offset;
        input.is_switch_pressed = true;
    }
    const int info = field(report, info_field);
    if (info != 0 && info != 1) return std::nullopt;
    input.asks_for_calibration = info == 1;
    return input;
}

ArmOutput currents_report(ArmGeneration generation, const std::array<int, 3>& currents_ma) noexcept {
    ArmOutput output;
    output.size = 1 + report_bytes(generation);
    for (std::size_t i = 0; i < 3; ++i)
        set_field(output, i, std::clamp(currents_ma[i], -most_current_ma, most_current_ma));
    return output;
}

ArmOutput counters_report(const std::array<int, 3>& arm_counts) noexcept {
    ArmOutput output;
    output.size = 1 + report_bytes(ArmGeneration::second);
    set_field(output, command_field, set_counters);
    for (std::size_t i = 0; i < 3; ++i) set_field(output, first_attribute_field + i, arm_counts[i]);
    return output;
}

namespace {

/// Longer than any report of the family, so that one that is too long shows.
constexpr std::size_t most_report_bytes = 64;
/// A device that talks faster than it is listened to must not keep the listener for ever.
constexpr int most_reports_at_once = 256;
constexpr std::array<int, 3> no_current_ma{};

std::array<int, 3> in_ma(const glm::dvec3& currents_a) {
    std::array<int, 3> ma{};
    for (int i = 0; i < 3; ++i)
        ma[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(1000.0 * currents_a[i]));
    return ma;
}

}  // namespace

ArmLink::ArmLink(const ArmProfile& profile, HidConnection& connection, double now_s)
    : profile_(profile),
      kinematics_(profile),
      connection_(connection),
      empty_s_(now_s),
      switch_(profile.switch_use),
      report_s_(now_s),
      sent_s_(now_s),
      wanted_s_(now_s) {}

ArmLink::~ArmLink() {
    if (!is_gone_) connection_.write(currents_report(generation_, no_current_ma).bytes());
}

void ArmLink::receive(int wait_ms, double now_s) noexcept {
    received_s_ = empty_s_;
    std::array<std::uint8_t, most_report_bytes> buffer;
    for (int i = 0; i < most_reports_at_once && !is_gone_; ++i) {
        const int bytes = connection_.read(buffer, i == 0 ? wait_ms : 0);
        if (bytes == 0) {
            empty_s_ = now_s;
            return;
        }
        if (bytes < 0) {
            is_gone_ = true;
            return;
        }
        is_answer_due_ = true;
        const auto input = decode_arm_report({buffer.data(), static_cast<std::size_t>(bytes)});
        const bool is_as_before = input && (state_ == State::waking || input->generation == generation_);
        if (is_as_before) {
            received_ = input;
        } else {
            ++malformed_count_;
        }
    }
}

std::array<int, 3> ArmLink::counts_of(const ArmInput& input) const noexcept {
    std::array<int, 3> counts = input.arm_counts;
    for (std::size_t i = 0; i < 3; ++i) {
        if (input.generation == ArmGeneration::first) {
            counts[i] = profile_.home_counts[i] - counts[i];
        } else if (profile_.calibration == CalibrationMethod::at_power_up) {
            counts[i] += profile_.home_counts[i];
        }
    }
    return counts;
}

void ArmLink::calibrate(const ArmInput& input) noexcept {
    if (profile_.calibration == CalibrationMethod::at_power_up) {
        state_ = State::waiting;
        return;
    }
    if (input.asks_for_calibration) {
        is_calibrating_ = true;
        return;
    }
    if (!is_calibrating_) return;
    is_calibrating_ = false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::abs(input.arm_counts[i] - profile_.home_counts[i]) > calibration_tolerance_counts) return;
    }
    state_ = State::waiting;
}

void ArmLink::take_over(const ArmInput& input, double now_s) noexcept {
    if (state_ == State::waking) {
        generation_ = input.generation;
        state_ = State::uncalibrated;
    }
    const bool asks = input.asks_for_calibration && profile_.calibration == CalibrationMethod::by_switch;
    if (state_ != State::uncalibrated && asks) {
        state_ = State::uncalibrated;
        reading_.connected = false;
    }
    if (state_ == State::uncalibrated) calibrate(input);
    if (state_ == State::waiting || state_ == State::driving) read_position(input, now_s);
    report_s_ = now_s;
}

void ArmLink::read_position(const ArmInput& input, double now_s) noexcept {
    if (!reading_.connected) sensor_ = PositionSensor(0.0);
    switch_.read(input.is_switch_pressed, now_s);
    angles_rad_ = kinematics_.angles_rad(counts_of(input));
    const glm::dvec3 hand_mm = kinematics_.position_mm(angles_rad_);
    sensor_.read(clutch_.position_mm(hand_mm, switch_.is_clutch()), now_s - report_s_);
    reading_ = {.position_mm = sensor_.position_mm(),
                .velocity_mm_per_s = sensor_.velocity_mm_per_s(),
                .spindle_axis = kinematics_.spindle_axis(angles_rad_, input.stylus_counts),
                .pedal = {.is_down = switch_.is_pedal(), .said_s = received_s_},
                .connected = true};
}

void ArmLink::consider_output(double now_s, const std::optional<glm::dvec3>& wanted_n) noexcept {
    if (wanted_n) {
        wanted_n_ = *wanted_n;
        wanted_s_ = now_s;
        has_force_ = true;
    }
    const bool may_drive =
        has_force_ && now_s - wanted_s_ <= longest_force_age_s && reading_.connected && !switch_.is_clutch();
    if (state_ == State::driving && !may_drive) state_ = State::waiting;
    if (state_ == State::waiting && may_drive && glm::length(wanted_n_) <= small_force_n)
        state_ = State::driving;
}

void ArmLink::send(double now_s) noexcept {
    const glm::dvec3 force_n =
        sent_force_.next(state_ == State::driving ? std::optional(wanted_n_) : std::nullopt, now_s);
    const bool is_silent = now_s - std::max(report_s_, sent_s_) >= wake_after_s;
    if (!is_answer_due_ && !is_silent) return;
    glm::dvec3 currents_a(0.0);
    if (is_answer_due_)
        currents_a = capped_currents_a(kinematics_.currents_a(angles_rad_, force_n), profile_.max_current_a);
    const bool sets_counters = state_ == State::uncalibrated && is_calibrating_;
    const ArmOutput output = sets_counters ? counters_report(profile_.home_counts)
                                           : currents_report(generation_, in_ma(currents_a));
    if (!connection_.write(output.bytes())) is_gone_ = true;
    is_answer_due_ = false;
    sent_s_ = now_s;
}

void ArmLink::answer(double now_s, const std::optional<glm::dvec3>& wanted_n) noexcept {
    if (received_) {
        take_over(*received_, now_s);
        received_.reset();
    } else if (now_s - report_s_ >= silent_after_s) {
        reading_.connected = false;
    }
    consider_output(now_s, wanted_n);
    if (!is_gone_) send(now_s);
    if (is_gone_ || now_s - report_s_ >= given_up_after_s) {
        state_ = State::gone;
        reading_.connected = false;
    }
}

const char* ArmLink::notice() const noexcept {
    switch (state_) {
        case State::waking:
            return malformed_count_ == 0 ? "the haptic arm does not answer yet"
                                         : "the haptic arm sends reports of another kind than its family's";
        case State::uncalibrated:
            if (generation_ == ArmGeneration::first) {
                return "this arm has no calibration switch: its profile must say method = \"power-up\"";
            }
            return is_calibrating_
                       ? "calibrating the haptic arm"
                       : "hold the haptic arm at its calibration position and press the calibration "
                         "switch; there is no force before";
        case State::gone:
            return "the haptic arm does not answer any more";
        case State::waiting:
        case State::driving:
            return reading_.connected ? "" : "the haptic arm is silent";
    }
    return "";
}

}  // namespace osteomill
