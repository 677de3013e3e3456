// A burr: its head, its shank and its cutting coefficients, as the scene declares them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

// The shape of a burr's cutting head: the ball, or a body of revolution with flat or tapered sides.

/// `ball`: a sphere. `cylinder`: straight sides (a fissure burr). `cone`: tapered sides. `barrel`: widest in
/// the middle. `pear`: a half ball at the tip that tapers to the neck.
enum class HeadShape { ball, cylinder, cone, barrel, pear };

inline constexpr std::array<std::string_view, 5> head_shape_names{"ball", "cylinder", "cone", "barrel",
                                                                  "pear"};

/// The head's sizes besides the burr's diameter, which is the largest of the head. A ball has none.
struct BurrHead {
    HeadShape shape = HeadShape::ball;
    double length_mm = 0.0;         ///< from the tip to the neck's end, along the spindle
    double tip_diameter_mm = 0.0;   ///< at the tip's face; of a pear nothing
    double neck_diameter_mm = 0.0;  ///< at the face towards the shank

    bool operator==(const BurrHead&) const = default;
};

/// A head of the usual proportions: a cone half as wide at its tip, a barrel 0.7 as wide at both ends, a pear
/// 0.6 as wide at its neck.
BurrHead usual_head(HeadShape shape, double diameter_mm, double length_mm);

/// Throws std::invalid_argument unless the head is a ball with nothing else set, or its length lies within
/// half its diameter to 30 mm (of a pear: from one diameter on), and its ends are between 0.3 times the
/// diameter and the diameter; a cylinder's are the diameter, and one end of a cone is.
void require_valid(const BurrHead& head, double diameter_mm);

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

// The burr's own axes: origin at the sphere's centre, +z along the spindle from tip to shank.

/// Columns are the burr's x, y, z axes in patient LPS; right-handed, orthonormal. `spindle_axis` is a unit
/// vector. The direction of x is immaterial (the burr turns), but it varies continuously except near a
/// spindle along -z (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
inline glm::dmat3 burr_frame(const glm::dvec3& spindle_axis) {
    const glm::dvec3& n = spindle_axis;
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace osteomill
