#include "haptic_server/device/haply/haply_arm.h"

#include <chrono>
#include <thread>

#include "haptic_server/device/arm_spring.h"
#include "haptic_server/device/haply/inverse3_profile.h"

namespace osteomill {

bool HaplyArm::await(const std::function<bool()>& gives_up) {
    while (!link_.round_trip_s()) {
        if (gives_up()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

glm::dvec3 HaplyArm::workspace_middle_mm() const {
    return inverse3_profile.workspace_middle_mm;
}

DeviceLimits HaplyArm::limits() const {
    return with_stiffest_spring({.max_force_n = inverse3_profile.max_force_n,
                                 .max_stiffness_n_per_mm = inverse3_profile.max_stiffness_n_per_mm,
                                 .apparent_mass_kg = inverse3_profile.apparent_mass_kg,
                                 .position_resolution_mm = inverse3_profile.position_step_mm},
                                delay_s());
}

DeviceState HaplyArm::read(double now_s) noexcept {
    if (link_.refresh()) permission_.renew(now_s);
    const HaplyReading& newest = link_.reading();
    const bool is_there = permission_.holds(now_s) && newest.is_ready;
    return {.position_mm = newest.tool_mm,
            .velocity_mm_per_s = newest.velocity_mm_per_s,
            .spindle_axis = newest.spindle_axis,
            .pedal = is_there && newest.pedal,
            .burr = newest.burr,
            .connected = is_there};
}

}  // namespace osteomill
