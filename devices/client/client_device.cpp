#include "devices/client/client_device.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/scene/device_mapping.h"

namespace osteomill {

glm::dvec3 TargetLimit::limited(const glm::dvec3& wanted_mm, const glm::dvec3& burr_mm,
                                double now_s) noexcept {
    glm::dvec3 target_mm = wanted_mm;
    const glm::dvec3 reach_mm = wanted_mm - burr_mm;
    if (const double length_mm = glm::length(reach_mm); !(length_mm <= longest_reach_mm)) {
        // The length of a finite vector may be none: it is then too far in any direction.
        target_mm = std::isfinite(length_mm) ? burr_mm + reach_mm * (longest_reach_mm / length_mm) : burr_mm;
        was_out_of_reach_.store(true, std::memory_order_relaxed);
    }

    room_left_mm_ = std::min(room_mm, room_left_mm_ + fastest_hand_mm_per_s * (now_s - limited_s_));
    limited_s_ = now_s;
    const glm::dvec3 step_mm = target_mm - target_mm_;
    const double step_length_mm = glm::length(step_mm);
    const double allowed_mm = std::min(step_length_mm, room_left_mm_);
    if (allowed_mm < step_length_mm) {
        target_mm = target_mm_ + step_mm * (allowed_mm / step_length_mm);
        was_too_fast_.store(true, std::memory_order_relaxed);
    }
    room_left_mm_ -= allowed_mm;
    return target_mm_ = target_mm;
}

const char* TargetLimit::notice() const noexcept {
    const bool reach = was_out_of_reach_.load(std::memory_order_relaxed);
    const bool speed = was_too_fast_.load(std::memory_order_relaxed);
    // The values of operator_command.h, which the messages below state.
    static_assert(longest_reach_mm == 6.0 && fastest_hand_mm_per_s == 500.0);
    if (reach && speed)
        return "the operator's target was more than 6 mm from the burr at the arm, and faster than a hand "
               "(500 mm/s): "
               "such targets are clamped";
    if (reach)
        return "the operator's target was more than 6 mm from the burr at the arm: such targets are clamped";
    if (speed) return "the operator's target was faster than a hand (500 mm/s): such targets are clamped";
    return "";
}

ClientDevice::ClientDevice(OperatorChannel& commands, const ToolPose& start_pose,
                           const DeviceMapping& mapping, const ArmModel& arm, const HandModel& hand,
                           std::function<Time()> clock)
    : commands_(commands),
      mapping_(mapping),
      arm_(arm),
      held_arm_(arm, hand, position_in_device_mm(mapping, start_pose.position_mm)),
      wanted_(start_pose),
      target_(start_pose),
      limit_(position_in_device_mm(mapping, start_pose.position_mm)),
      clock_(std::move(clock)) {}

void ClientDevice::take_over_command(double now_s) noexcept {
    if (!commands_.refresh()) {
        pedal_.is_down = pedal_.is_down || std::exchange(presses_next_, false);
        return;
    }
    const auto& [command, heard, client, releases] = commands_.front();
    presses_next_ = false;
    const bool was_up = releases != 0 && (client != heard_client_ || releases != heard_releases_);
    heard_client_ = client;
    heard_releases_ = releases;
    const double axis_length = command ? glm::length(command->spindle_axis) : 0.0;
    if (!command || !is_finite(command->hand_target_mm) || !std::isfinite(axis_length) ||
        axis_length < 1e-6 || is_of_old_place(command->hand_target_mm, now_s)) {
        permission_.withdraw();
        pedal_ = {};
        return;
    }
    permission_.renew(said_at(now_s, std::chrono::duration<double>(clock_() - heard).count()));
    presses_next_ = command->pedal && was_up;
    pedal_ = {
        .is_down = command->pedal && !presses_next_, .said_s = permission_.renewed_s(), .speaker = client};
    if (!permission_.holds(now_s)) return;
    const glm::dvec3 target_mm = limit_.limited(position_in_device_mm(mapping_, command->hand_target_mm),
                                                held_arm_.truth().position_mm(), now_s);
    wanted_ = {position_in_patient_mm(mapping_, target_mm), command->spindle_axis / axis_length};
    burr_ = command->burr;
}

void ClientDevice::end_permission() noexcept {
    wanted_ = target_;
    limit_.resume_at(position_in_device_mm(mapping_, target_.position_mm));
}

bool ClientDevice::is_of_old_place(const glm::dvec3& target_mm, double now_s) noexcept {
    if (!moved_) return false;
    if (now_s - moved_->at_s <= unheard_s &&
        glm::distance(target_mm, moved_->target_mm) < glm::distance(target_mm, moved_->to_mm))
        return true;
    moved_.reset();
    return false;
}

void ClientDevice::set_mapping(const DeviceMapping& mapping) noexcept {
    const glm::dvec3 axis_in_device = direction_in_device(mapping_, target_.spindle_axis);
    mapping_ = mapping;
    target_ = {position_in_patient_mm(mapping_, held_arm_.truth().position_mm()),
               direction_in_patient(mapping_, axis_in_device)};
    if (const auto& last = commands_.front().command)
        moved_ = {.target_mm = last->hand_target_mm, .to_mm = target_.position_mm, .at_s = read_at_s_};
    permission_.withdraw();
    pedal_ = {};
    presses_next_ = false;
    end_permission();
}

DeviceState ClientDevice::read(double now_s) noexcept {
    // Checked before a message is taken, too: if this tick is late, the permission has run out meanwhile,
    // though a fresh message waits.
    if (!permission_.holds(now_s)) end_permission();
    take_over_command(now_s);
    if (!permission_.holds(now_s)) end_permission();
    const double elapsed_s = now_s - read_at_s_;
    read_at_s_ = now_s;

    const double share = elapsed_s / (target_filter_s + elapsed_s);
    target_.position_mm += share * (wanted_.position_mm - target_.position_mm);

    const glm::dvec3 axis = target_.spindle_axis + share * (wanted_.spindle_axis - target_.spindle_axis);
    // Two opposite axes have no direction between them; the old one stays until the operator turns on.
    if (glm::length(axis) > 1e-3) target_.spindle_axis = glm::normalize(axis);

    const glm::dvec3 axis_in_device = direction_in_device(mapping_, target_.spindle_axis);
    held_arm_.advance(now_s, position_in_device_mm(mapping_, target_.position_mm), axis_in_device);
    return {.position_mm = held_arm_.sensor().position_mm(),
            .velocity_mm_per_s = held_arm_.sensor().velocity_mm_per_s(),
            .spindle_axis = axis_in_device,
            .pedal = pedal_,
            .burr = burr_};
}

}  // namespace osteomill
