#include "devices/simulated/prescribed_device.h"

#include <limits>

namespace osteomill {

PrescribedDevice::PrescribedDevice(const ToolPose& start, const DeviceMapping& mapping,
                                   const DeviceLimits& limits)
    : mapping_(mapping), limits_(limits), hand_(as_written(start)) {}

DeviceState PrescribedDevice::read(double now_s) noexcept {
    const glm::dvec3 position_mm = position_in_device_mm(mapping_, hand_.position_mm);
    const double passed_s = now_s - before_s_;
    const glm::dvec3 velocity_mm_per_s =
        before_mm_ && passed_s > 0.0 ? (position_mm - *before_mm_) / passed_s : glm::dvec3(0.0);
    before_mm_ = position_mm;
    before_s_ = now_s;
    return {.position_mm = position_mm,
            .velocity_mm_per_s = velocity_mm_per_s,
            .spindle_axis = direction_in_device(mapping_, hand_.spindle_axis),
            .pedal = {.is_down = pedal_, .said_s = now_s},
            .burr = burr_};
}

DeviceState RecordedDevice::read(double now_s) noexcept {
    using Pedal = TickInput::Pedal;
    const TickInput input = tick_.input.value_or(TickInput{});
    const glm::dvec3 position_mm =
        input.is_placed && before_mm_ ? *before_mm_ : position_in_device_mm(mapping_, tick_.hand_mm);
    const double passed_s = now_s - before_s_;
    DeviceState state{
        .position_mm = position_mm,
        .spindle_axis = direction_in_device(mapping_, tick_.spindle_axis),
        .pedal = {.is_down = input.pedal == Pedal::down || input.pedal == Pedal::waiting, .said_s = now_s},
        .burr = input.burr,
        .connected = input.pedal != Pedal::no_hand};
    if (before_mm_ && passed_s > 0.0) state.velocity_mm_per_s = (position_mm - *before_mm_) / passed_s;
    if (input.pedal == Pedal::lapsed) state.pedal.said_s = -std::numeric_limits<double>::infinity();
    if (input.pedal == Pedal::waiting) state.pedal.acts_after_s = std::numeric_limits<double>::infinity();
    before_mm_ = position_mm;
    before_s_ = now_s;
    return state;
}

}  // namespace osteomill
