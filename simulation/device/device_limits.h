// Limits of an arm's abilities, in its own space and in the patient's: two types, so that one is not confused
// with the other. device_mapping.h says how a figure converts.
#pragma once

#include "common/scene/device_mapping.h"

namespace osteomill {

/// In the device's millimetres.
struct DeviceLimits {
    double max_force_n = 3.3;
    double max_stiffness_n_per_mm = 1.5;  ///< stiffest spring that it renders stably
    double apparent_mass_kg = 0.045;
    double position_resolution_mm = 0.0;       ///< step of a position reading; 0: negligible
    double damping_n_s_per_mm = 0.004;         ///< the damper beside that spring
    const char* stiffness_is_limited_by = "";  ///< for people
    bool gives_force = true;                   ///< false: forces are shown to people, and felt by nobody
};

/// The same in the patient's millimetres, in which couplings reckon.
struct PatientLimits {
    double max_force_n = DeviceLimits{}.max_force_n;
    double max_stiffness_n_per_mm = DeviceLimits{}.max_stiffness_n_per_mm;
    double apparent_mass_kg = DeviceLimits{}.apparent_mass_kg;
    double position_resolution_mm = DeviceLimits{}.position_resolution_mm;
    double damping_n_s_per_mm = DeviceLimits{}.damping_n_s_per_mm;
    ArmScale scale{};  ///< for a coupling's own demands on the arm
};

constexpr PatientLimits in_patient_space(const DeviceLimits& arm, ArmScale scale) {
    return {.max_force_n = arm.max_force_n,
            .max_stiffness_n_per_mm = scale.stiffness_n_per_mm(arm.max_stiffness_n_per_mm),
            .apparent_mass_kg = scale.mass_kg(arm.apparent_mass_kg),
            .position_resolution_mm = scale.length_mm(arm.position_resolution_mm),
            .damping_n_s_per_mm = scale.damping_n_s_per_mm(arm.damping_n_s_per_mm),
            .scale = scale};
}

}  // namespace osteomill
