// Kinematics of an arm: from the counts of its encoders to the tip's position, and from a force there to
// motor currents.
//
//     theta_i = direction_i (2 pi count_i / counts_per_rev_i) capstan_i / body_i          i = A, B, C
//     x = cos A (L_b sin B + L_c sin C) - o_x
//     y = sin A (L_b sin B + L_c sin C) - o_y
//     z = L_a + L_b cos B - L_c cos C - o_z
//     tau = J^T F,  J = d(x, y, z)/d(A, B, C);  current_i = direction_i tau_i (capstan_i / body_i) / k_i
//
// B and C are absolute angles, so J^T F needs no coupling term. Source: the published arms of
// forsslund/haptikfabrikenapi. Device space: origin in the middle of the workspace, z up, mm. The arm's
// weight is not compensated.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "devices/hid/arm_profile.h"

namespace osteomill {

class ArmKinematics {
  public:
    explicit ArmKinematics(const ArmProfile& profile);

    /// Angles of the bodies A, B, C. Real-time safe, like all functions here.
    glm::dvec3 angles_rad(const std::array<int, 3>& counts) const noexcept;
    glm::dvec3 position_mm(const glm::dvec3& angles_rad) const noexcept;
    /// Columns: d position / d A, B, C, in mm per rad.
    glm::dmat3 jacobian_mm(const glm::dvec3& angles_rad) const noexcept;

    /// Motor currents that make the tip push with `force_n`; not capped.
    glm::dvec3 currents_a(const glm::dvec3& angles_rad, const glm::dvec3& force_n) const noexcept;

    /// The force at the tip of motors with these currents: the inverse of currents_a. If the arm is stretched
    /// or folded, some forces do not reach the motors, and the result is not finite.
    glm::dvec3 force_n(const glm::dvec3& angles_rad, const glm::dvec3& currents_a) const noexcept;

    /// Unit vector from tip to shank: the profile's fixed axis, or by the stylus's counters, Rz(A) Ry(pi/2 -
    /// C) Rx(D) Ry(E) Rx(F) with D, E, F from the counters f, e, d.
    glm::dvec3 spindle_axis(const glm::dvec3& angles_rad,
                            const std::array<int, 3>& stylus_counts) const noexcept;

    /// How far one count of any encoder moves the tip at most, at the calibration position.
    double resolution_mm() const noexcept;

  private:
    ArmProfile profile_;
    glm::dvec3 rad_per_count_;
    glm::dvec3 amperes_per_nmm_;  // current per torque on a body
};

/// The currents as they are, or all made smaller alike so that none exceeds `most_a`: the force gets weaker
/// and keeps its direction. Currents that are not finite become zero. Real-time safe.
glm::dvec3 capped_currents_a(const glm::dvec3& currents_a, double most_a) noexcept;

}  // namespace osteomill
