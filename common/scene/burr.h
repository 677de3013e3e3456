// A burr: its head, its shank and its cutting coefficients, as the scene declares them.
#pragma once

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/scene/burr_head.h"

namespace osteomill {

/// Which way the burr turns, seen from the handpiece (from the shank towards the tip).
enum class SpindleSense { clockwise, counter_clockwise };
inline constexpr std::array spindle_sense_names{"clockwise", "counter-clockwise"};
/// Speed of a burr for which a scene gives none.
inline constexpr double default_spindle_rpm = 10'000.0;

/// A point of the shank behind a burr: neck, shank and handpiece are straight cones about the spindle, from
/// one point of a profile to the next.
struct ShankPoint {
    double height_mm = 0.0;  ///< above the burr's centre, along the spindle
    double radius_mm = 0.0;

    bool operator==(const ShankPoint&) const = default;
};

/// Heights ascend. Empty: nothing behind the burr touches bone.
using ShankProfile = std::vector<ShankPoint>;

/// Throws std::invalid_argument unless the profile is empty or has 2 to 8 points, their radii within 0.05 to
/// 30 mm, their heights ascending by 0.01 mm or more from half the burr's radius to 200 mm, the last beyond
/// the burr.
void require_valid(const ShankProfile& shank, double burr_radius_mm);

struct Burr {
    std::string name{};
    double diameter_mm = 5.0;  ///< the largest of the head
    BurrHead head{};
    int edges = 6;
    double spindle_rev_per_s = default_spindle_rpm / 60.0;
    /// K_t, K_r, K_a for bone of relative stiffness 1.
    glm::dvec3 cutting_coefficients_n_per_mm2{230.0, 40.0, 20.0};
    /// K_te, K_re, K_ae for the same bone: force of each mm of edge that cuts, however thin its chip. The
    /// published law has no such force.
    glm::dvec3 edge_coefficients_n_per_mm{0.0};
    SpindleSense sense = SpindleSense::clockwise;
    ShankProfile shank{};
    /// Run-out of the edges in the handpiece, as a dial gauge reads it over a turn: twice the eccentricity.
    double run_out_mm = 0.02;

    double radius_mm() const { return 0.5 * diameter_mm; }
    /// +1 when the burr turns towards +psi of the burr frame (+z from tip to shank), -1 for a clockwise burr.
    double sigma() const { return sense == SpindleSense::clockwise ? -1.0 : 1.0; }

    bool is_ball() const { return head.shape == HeadShape::ball; }
    bool has_edge_force() const { return edge_coefficients_n_per_mm != glm::dvec3(0.0); }

    bool operator==(const Burr&) const = default;
};

/// Whether any of a set has a shank that bone can touch.
bool has_shank(const std::vector<Burr>& burrs);

/// The usual set: 1, 1.5, 2, 3, 4 and 5 mm, six edges, the published coefficients, clockwise.
std::vector<Burr> default_burr_set(double spindle_rev_per_s);

/// The spindle's motor, whose speed falls under load. The fall is heard (docs/sound.md) and not felt: cut and
/// force are computed as if the spindle kept its speed.
///
/// Full speed up to `steady_torque_n_mm`, as a motor with a regulator holds it; from there the speed falls
/// along a line to a stand at `stall_torque_n_mm`.
struct Motor {
    double stall_torque_n_mm = 0.0;   ///< above the other
    double steady_torque_n_mm = 0.0;  ///< 0: the speed falls from the first load on, as an air turbine's does

    bool operator==(const Motor&) const = default;
};

/// Speed under a load as a share of that in air, 1 to 0.
inline double speed_share_under(const Motor& motor, double torque_n_mm) noexcept {
    const double over_n_mm = torque_n_mm - motor.steady_torque_n_mm;
    return 1.0 - std::clamp(over_n_mm / (motor.stall_torque_n_mm - motor.steady_torque_n_mm), 0.0, 1.0);
}

}  // namespace osteomill
