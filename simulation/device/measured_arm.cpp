#include "simulation/device/measured_arm.h"

#include <algorithm>
#include <limits>

namespace osteomill {

namespace {

constexpr double least_damping_n_s_per_mm = 0.001;
constexpr double most_damping_n_s_per_mm = 0.012;
constexpr double damping_step_n_s_per_mm = 0.0005;

ArmFigures figures_of(const DeviceLimits& arm, double delay_s, const MeasuredArm& measured,
                      double calm_n_per_mm) {
    return {.claimed_n_per_mm = ArmSpring::share_of_edge * calm_n_per_mm,
            .claimed_by = "with half as much again it was not calm when it was measured",
            .mass_kg = std::min(arm.apparent_mass_kg, measured.moving_mass_kg.value_or(arm.apparent_mass_kg)),
            .position_resolution_mm = std::max(arm.position_resolution_mm, measured.resolution_mm()),
            .delay_s = std::max(delay_s, measured.delay_s.value_or(delay_s))};
}

}  // namespace

DeviceLimits with_measured_spring(DeviceLimits arm, double delay_s, const MeasuredArm& measured) {
    const ArmFigures figures = figures_of(arm, delay_s, measured, measured.calm_n_per_mm);
    const ArmSpring spring = spring_beside(figures, measured.damping_n_s_per_mm);
    arm.max_stiffness_n_per_mm = std::max(spring.stiffness_n_per_mm, ArmSpring::softest_n_per_mm);
    arm.damping_n_s_per_mm = spring.damping_n_s_per_mm;
    arm.stiffness_is_limited_by = spring.limited_by;
    arm.apparent_mass_kg = figures.mass_kg;
    arm.position_resolution_mm = figures.position_resolution_mm;
    return arm;
}

ArmSpring hoped_spring(const DeviceLimits& arm, double delay_s, const MeasuredArm& measured) {
    const ArmFigures figures = figures_of(arm, delay_s, measured, std::numeric_limits<double>::infinity());
    ArmSpring best{.stiffness_n_per_mm = 0.0};
    const int steps = static_cast<int>(
        (most_damping_n_s_per_mm - least_damping_n_s_per_mm) / damping_step_n_s_per_mm + 0.5);
    for (int i = 0; i <= steps; ++i) {
        const ArmSpring spring =
            spring_beside(figures, least_damping_n_s_per_mm + i * damping_step_n_s_per_mm);
        if (spring.stiffness_n_per_mm > best.stiffness_n_per_mm) best = spring;
    }
    return best;
}

}  // namespace osteomill
