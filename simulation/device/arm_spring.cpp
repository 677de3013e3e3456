#include "simulation/device/arm_spring.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace osteomill {

namespace {

constexpr double own_damping_n_s_per_m = 0.5;
constexpr std::array dampings_n_s_per_mm{0.004, 0.005, 0.008, 0.012, 0.002, 0.001};
/// A gain in stiffness below 5 % does not justify a stronger damper.
constexpr double worth = 1.05;

/// Whether arm, spring, damper and filter are stable from tick to tick. The state: x, v, the last x, the
/// filtered v, forces under way. SI.
bool holds(double mass_kg, double stiffness_n_per_m, double damping_n_s_per_m, int ticks_late) {
    constexpr double t = ArmSpring::tick_s;
    constexpr double share = t / (ArmSpring::hand_filter_s + t);
    const double b = own_damping_n_s_per_m;
    const double decay = std::exp(-b / mass_kg * t);
    const double coasts_s = mass_kg / b * (1.0 - decay);
    const int size = 4 + ticks_late;
    Eigen::RowVectorXd filtered = Eigen::RowVectorXd::Zero(size);
    filtered.head<4>() << share / t, 0.0, -share / t, 1.0 - share;
    Eigen::RowVectorXd force = -damping_n_s_per_m * filtered;
    force(0) -= stiffness_n_per_m;
    Eigen::MatrixXd tick = Eigen::MatrixXd::Zero(size, size);
    const Eigen::RowVectorXd acts = ticks_late == 0 ? force : Eigen::RowVectorXd::Unit(size, 4);
    tick.row(0) = (t - coasts_s) / b * acts;
    tick(0, 0) += 1.0;
    tick(0, 1) += coasts_s;
    tick.row(1) = (1.0 - decay) / b * acts;
    tick(1, 1) += decay;
    tick(2, 0) = 1.0;
    tick.row(3) = filtered;
    for (int i = 4; i < size - 1; ++i) tick(i, i + 1) = 1.0;
    if (ticks_late > 0) tick.row(size - 1) = force;
    return tick.eigenvalues().cwiseAbs().maxCoeff() < 1.0;
}

double edge_n_per_mm(double mass_kg, double damping_n_s_per_mm, int ticks_late) {
    constexpr double per_m = 1000.0;
    double low = ArmSpring::softest_n_per_mm / 10.0;
    double high = 100.0;
    if (!holds(mass_kg, per_m * low, per_m * damping_n_s_per_mm, ticks_late)) return 0.0;
    for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(mass_kg, per_m * middle, per_m * damping_n_s_per_mm, ticks_late) ? low : high) = middle;
    }
    return low;
}

}  // namespace

double stiffest_wall_n_per_mm(double mass_kg, double damping_n_s_per_mm, double delay_ms) {
    if (!(mass_kg > 1e-4) || !std::isfinite(mass_kg)) return 0.0;
    const double whole_ms = std::floor(delay_ms);
    const double part = delay_ms - whole_ms;
    const auto ticks = static_cast<int>(whole_ms);
    const double before = edge_n_per_mm(mass_kg, damping_n_s_per_mm, ticks);
    const double after = part > 0.0 ? edge_n_per_mm(mass_kg, damping_n_s_per_mm, ticks + 1) : before;
    if (before == 0.0 || after == 0.0) return 0.0;
    return 1.0 / ((1.0 - part) / before + part / after);  // compliance grows evenly with the delay
}

ArmSpring spring_beside(const ArmFigures& arm, double damping_n_s_per_mm) {
    using S = ArmSpring;
    constexpr double t = S::tick_s;
    ArmSpring spring{.stiffness_n_per_mm = arm.claimed_n_per_mm,
                     .damping_n_s_per_mm = damping_n_s_per_mm,
                     .limited_by = arm.claimed_by};
    const auto limit = [&spring](double n_per_mm, const char* by) {
        if (n_per_mm >= spring.stiffness_n_per_mm) return;
        spring.stiffness_n_per_mm = n_per_mm;
        spring.limited_by = by;
    };
    const double late_ms = std::max(1.0, 1000.0 * std::min(arm.delay_s, longest_delay_s));
    limit(S::share_of_edge * stiffest_wall_n_per_mm(arm.mass_kg, damping_n_s_per_mm, late_ms),
          "no more holds on an arm of its mass with its delay");
    const double step_mm = arm.position_resolution_mm;
    if (step_mm > 0.0) {
        if (arm.friction_n) limit(2.0 * *arm.friction_n / step_mm, "its friction stills no more");
        const double damper_n_per_mm = damping_n_s_per_mm / (S::hand_filter_s + t);
        limit(S::felt_step_n / (S::share_of_step * step_mm) - damper_n_per_mm,
              "with more the steps of its encoders are felt");
    }
    const double damper_n = damping_n_s_per_mm * S::touch_mm_per_s * t / (S::burr_filter_s + t);
    limit((S::felt_jump_n - damper_n) / (S::touch_mm_per_s * t), "with more a touch is a jump");
    return spring;
}

ArmSpring stiffest_spring(const ArmFigures& arm) {
    ArmSpring best{.stiffness_n_per_mm = 0.0};
    for (const double damping : dampings_n_s_per_mm) {
        const ArmSpring spring = spring_beside(arm, damping);
        if (spring.stiffness_n_per_mm > worth * best.stiffness_n_per_mm) best = spring;
        if (best.stiffness_n_per_mm >= arm.claimed_n_per_mm) break;
    }
    best.stiffness_n_per_mm = std::max(best.stiffness_n_per_mm, ArmSpring::softest_n_per_mm);
    return best;
}

DeviceLimits with_stiffest_spring(DeviceLimits arm, double delay_s, std::optional<double> friction_n) {
    const ArmSpring spring = stiffest_spring({.claimed_n_per_mm = arm.max_stiffness_n_per_mm,
                                              .mass_kg = arm.apparent_mass_kg,
                                              .position_resolution_mm = arm.position_resolution_mm,
                                              .friction_n = friction_n,
                                              .delay_s = delay_s});
    arm.max_stiffness_n_per_mm = spring.stiffness_n_per_mm;
    arm.damping_n_s_per_mm = spring.damping_n_s_per_mm;
    arm.stiffness_is_limited_by = spring.limited_by;
    return arm;
}

}  // namespace osteomill
