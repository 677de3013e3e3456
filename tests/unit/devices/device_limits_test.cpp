#include <gtest/gtest.h>

#include "simulation/device/haptic_device.h"

namespace osteomill {
namespace {

TEST(DeviceLimits, AreInThePatientsMillimetresAsTheScaleHasIt) {
    // Four of the patient's for one of the arm's.
    const DeviceLimits arm{.max_force_n = 3.0,
                           .max_stiffness_n_per_mm = 1.6,
                           .apparent_mass_kg = 0.048,
                           .position_resolution_mm = 0.05};
    const PatientLimits patient = in_patient_space(arm, ArmScale(4.0));
    EXPECT_EQ(patient.max_force_n, 3.0) << "newtons are newtons";
    EXPECT_DOUBLE_EQ(patient.max_stiffness_n_per_mm, 0.4);
    EXPECT_DOUBLE_EQ(patient.apparent_mass_kg, 0.012);
    EXPECT_DOUBLE_EQ(patient.position_resolution_mm, 0.2);
    EXPECT_DOUBLE_EQ(patient.scale.damping_n_s_per_mm(0.004), 0.001);
    EXPECT_DOUBLE_EQ(patient.scale.speed_mm_per_s(100.0), 400.0);
    EXPECT_DOUBLE_EQ(patient.scale.energy_mj(0.5), 2.0);
}

TEST(DeviceLimits, DescribeOneArmInBothSpaces) {
    for (const double s : {0.01, 0.5, 1.0, 30.0, 100.0}) {
        const ArmScale scale(s);
        const double step_mm = 0.2;
        const double speed_mm_per_s = 7.0;
        EXPECT_DOUBLE_EQ(scale.stiffness_n_per_mm(1.5) * scale.length_mm(step_mm), 1.5 * step_mm)
            << "the same force of a spring";
        EXPECT_DOUBLE_EQ(scale.damping_n_s_per_mm(0.004) * scale.speed_mm_per_s(speed_mm_per_s),
                         0.004 * speed_mm_per_s)
            << "of a damper";
        EXPECT_DOUBLE_EQ(scale.mass_kg(0.045) * scale.speed_mm_per_s(speed_mm_per_s), 0.045 * speed_mm_per_s)
            << "and the same impulse";
        EXPECT_DOUBLE_EQ(
            0.5 * scale.stiffness_n_per_mm(1.5) * scale.length_mm(step_mm) * scale.length_mm(step_mm),
            scale.energy_mj(0.5 * 1.5 * step_mm * step_mm));
    }
}

}  // namespace
}  // namespace osteomill
