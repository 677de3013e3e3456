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

}  // namespace osteomill
