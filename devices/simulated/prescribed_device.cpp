#include "devices/simulated/prescribed_device.h"

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

}  // namespace osteomill
