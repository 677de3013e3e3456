#include "devices/simulated/recorded_device.h"

#include <limits>

namespace osteomill {

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
