#include "haptic_server/device/client_device.h"

#include <glm/geometric.hpp>

#include "common/bone/finite.h"
#include "common/scene/device_mapping.h"

namespace osteomill {

ClientDevice::ClientDevice(TripleBuffer<OperatorInput>& input, const ToolPose& start_pose,
                           const DeviceMapping& mapping, const ArmModel& arm, const HandModel& hand)
    : input_(input),
      mapping_(mapping),
      arm_(arm),
      held_arm_(arm, hand, position_in_device_mm(mapping, start_pose.position_mm)),
      wanted_(start_pose),
      target_(start_pose) {}

void ClientDevice::take_over_input() noexcept {
    if (!input_.refresh()) return;
    const OperatorInput& input = input_.front();
    pedal_ = false;
    if (!input.present) {
        wanted_ = target_;
        return;
    }
    const double axis_length = glm::length(input.hand_target.spindle_axis);
    if (!is_finite(input.hand_target.position_mm) || !std::isfinite(axis_length) || axis_length < 1e-6)
        return;
    wanted_ = {input.hand_target.position_mm, input.hand_target.spindle_axis / axis_length};
    pedal_ = input.pedal;
    burr_ = input.burr;
}

DeviceState ClientDevice::read(double now_s) noexcept {
    take_over_input();
    const double elapsed_s = now_s - read_at_s_;
    read_at_s_ = now_s;

    const double share = elapsed_s / (target_filter_s + elapsed_s);
    glm::dvec3 step_mm = share * (wanted_.position_mm - target_.position_mm);
    const double step_length_mm = glm::length(step_mm);
    const double longest_mm = target_limit_mm_per_s * elapsed_s;
    if (step_length_mm > longest_mm) step_mm *= longest_mm / step_length_mm;
    target_.position_mm += step_mm;

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
