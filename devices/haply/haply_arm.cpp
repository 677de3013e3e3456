#include "devices/haply/haply_arm.h"

#include <chrono>
#include <thread>

#include "devices/haply/inverse3_profile.h"
#include "simulation/device/arm_spring.h"

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
    const bool is_new = link_.refresh();
    const HaplyReading& newest = link_.reading();
    if (is_new)
        permission_.renew(
            said_at(now_s, std::chrono::duration<double>(HaplyLink::Clock::now() - newest.said).count()));
    const bool is_there = permission_.holds(now_s) && newest.is_ready;
    return {.position_mm = newest.tool_mm,
            .velocity_mm_per_s = newest.velocity_mm_per_s,
            .spindle_axis = newest.spindle_axis,
            .pedal = newest.has_grip ? PedalStatement{.is_down = newest.pedal,
                                                      .said_s = permission_.renewed_s(),
                                                      .speaker = newest.grip}
                                     : PedalStatement{},
            .burr = newest.burr,
            .connected = is_there};
}

}  // namespace osteomill
