#include "devices/hid/arm_kinematics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "common/bone/patient_space.h"

namespace osteomill {

namespace {

constexpr double mm_per_m = 1000.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

glm::dvec3 turned_about_x(double angle_rad, const glm::dvec3& v) noexcept {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

glm::dvec3 turned_about_y(double angle_rad, const glm::dvec3& v) noexcept {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

glm::dvec3 turned_about_z(double angle_rad, const glm::dvec3& v) noexcept {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

}  // namespace

ArmKinematics::ArmKinematics(const ArmProfile& profile) : profile_(profile) {
    for (int i = 0; i < 3; ++i) {
        const ArmJoint& joint = profile.joints[static_cast<std::size_t>(i)];
        const double gear = joint.direction * joint.capstan_m / joint.body_m;
        rad_per_count_[i] = gear * two_pi / joint.counts_per_rev;
        amperes_per_nmm_[i] = gear / (mm_per_m * joint.torque_constant_nm_per_a);
    }
}

glm::dvec3 ArmKinematics::angles_rad(const std::array<int, 3>& counts) const noexcept {
    return rad_per_count_ * glm::dvec3(counts[0], counts[1], counts[2]);
}

glm::dvec3 ArmKinematics::position_mm(const glm::dvec3& angles_rad) const noexcept {
    const auto& [la, lb, lc] = std::array{profile_.lengths_m.x, profile_.lengths_m.y, profile_.lengths_m.z};
    const double reach_m = lb * std::sin(angles_rad.y) + lc * std::sin(angles_rad.z);
    const glm::dvec3 tip_m(std::cos(angles_rad.x) * reach_m, std::sin(angles_rad.x) * reach_m,
                           la + lb * std::cos(angles_rad.y) - lc * std::cos(angles_rad.z));
    return mm_per_m * (tip_m - profile_.origin_m);
}

glm::dmat3 ArmKinematics::jacobian_mm(const glm::dvec3& angles_rad) const noexcept {
    const double ca = std::cos(angles_rad.x);
    const double sa = std::sin(angles_rad.x);
    const double lb_mm = mm_per_m * profile_.lengths_m.y;
    const double lc_mm = mm_per_m * profile_.lengths_m.z;
    const double reach_mm = lb_mm * std::sin(angles_rad.y) + lc_mm * std::sin(angles_rad.z);
    const double cb = std::cos(angles_rad.y);
    const double cc = std::cos(angles_rad.z);
    return {glm::dvec3(-sa * reach_mm, ca * reach_mm, 0.0),
            lb_mm * glm::dvec3(ca * cb, sa * cb, -std::sin(angles_rad.y)),
            lc_mm * glm::dvec3(ca * cc, sa * cc, std::sin(angles_rad.z))};
}

glm::dvec3 ArmKinematics::currents_a(const glm::dvec3& angles_rad, const glm::dvec3& force_n) const noexcept {
    return amperes_per_nmm_ * (glm::transpose(jacobian_mm(angles_rad)) * force_n);
}

glm::dvec3 ArmKinematics::force_n(const glm::dvec3& angles_rad, const glm::dvec3& currents_a) const noexcept {
    return glm::inverse(glm::transpose(jacobian_mm(angles_rad))) * (currents_a / amperes_per_nmm_);
}

glm::dvec3 ArmKinematics::spindle_axis(const glm::dvec3& angles_rad,
                                       const std::array<int, 3>& stylus_counts) const noexcept {
    if (!profile_.stylus) return profile_.fixed_axis;
    const StylusEncoders& stylus = *profile_.stylus;
    std::array<double, 3> def_rad{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t counter = 2 - i;
        def_rad[i] =
            stylus.directions[counter] * two_pi * stylus_counts[counter] / stylus.counts_per_rev[counter];
    }
    glm::dvec3 axis = turned_about_x(def_rad[2], stylus.spindle_axis);
    axis = turned_about_y(def_rad[1], axis);
    axis = turned_about_x(def_rad[0], axis);
    axis = turned_about_y(0.5 * std::numbers::pi - angles_rad.z, axis);
    return turned_about_z(angles_rad.x, axis);
}

double ArmKinematics::resolution_mm() const noexcept {
    const glm::dmat3 jacobian = jacobian_mm(angles_rad(profile_.home_counts));
    double coarsest_mm = 0.0;
    for (int i = 0; i < 3; ++i)
        coarsest_mm = std::max(coarsest_mm, glm::length(jacobian[i]) * std::abs(rad_per_count_[i]));
    return coarsest_mm;
}

glm::dvec3 capped_currents_a(const glm::dvec3& currents_a, double most_a) noexcept {
    if (!is_finite(currents_a)) return glm::dvec3(0.0);
    const double largest_a =
        std::max({std::abs(currents_a.x), std::abs(currents_a.y), std::abs(currents_a.z)});
    return largest_a > most_a ? currents_a * (most_a / largest_a) : currents_a;
}

}  // namespace osteomill
