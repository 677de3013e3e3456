// What a burr that advances along its tip would cut of a disc about the spindle's axis if the bone ended in a
// straight face there: the sums that show where the face is, and what the means of axis_means.h then miss.
//
// Places on the burr's surface are seen along the axis, (x, y) in burr axes and voxels, r = |(x, y)| < A. By
// the way of the centre, a unit vector v, the burr cuts there, over an area of this plane, the chip
//
//     h = max(0, n . v / cos kappa) = max(0, -v_z + (v_x x + v_y y) / sqrt(R^2 - r^2)),
//
// n the normal of the burr's surface. The face, whose outward normal N is seen as sin theta u, cuts the
// sphere where
//
//     u . (x, y) = d + cot theta (sqrt(R^2 - r^2) - sqrt(R^2 - d^2)),
//
// a curve that passes at the distance d from the axis; bone is on the side of -u. With chi = 1 there and M
// the weight of axis_means.h within r, 1/r_m its mean of 1/r, the sums are
//
//     volume  = int (1 - r^2 / A^2) h chi dA
//     moment  = int (1 - r^2 / A^2) h chi (x, y) dA
//     missing = int h chi ((1 - M) (x, y) / r^2, (1/r - 1/r_m) cos kappa) dA
//
// by quadrature on circles. On each, cells that the face cuts count with the share that it leaves.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptic_server/milling/instruction_set.h"

namespace osteomill {

/// Radius A, voxels. Large enough for the sums not to tell where the lattice lies.
inline constexpr float tip_disc_voxels = 3.3f;

/// Where a face cuts the burr's surface near the tip. Burr axes, voxels.
struct FaceAtTip {
    glm::dvec2 outward{1.0, 0.0};  ///< u, unit: from the cut to where it is missing
    double distance_voxels = 0.0;  ///< d, negative where the axis is outside the cut; |d| < R
    double cot_theta = 0.0;        ///< of the angle from the burr's surface to the face
};

/// The sums above, for a way of one voxel.
struct TipDiscSums {
    double volume = 0.0;
    glm::dvec2 moment{0.0};
    glm::dvec3 missing{0.0};
    glm::dvec3 per_distance{0.0};  ///< derivative of (volume, moment) by d
    glm::dvec3 per_turn{0.0};      ///< and by the angle of u, rad
};

/// Real-time safe but for its construction, which takes some microseconds.
class TipDisc {
  public:
    explicit TipDisc(InstructionSet instructions);

    /// The burr's radius, more than A, and the direction of its centre's way; unit, burr axes.
    void begin(double radius_voxels, const glm::dvec3& direction) noexcept;

    /// Of bone that ends in no face. A burr has begun, here and below.
    TipDiscSums whole() const noexcept;

    TipDiscSums cut_by(const FaceAtTip& face) const noexcept;

  private:
    static constexpr std::size_t circles_under_means = 6;
    static constexpr std::size_t circles = 10;
    static constexpr std::size_t angles = 32;

    /// Of one circle: the ring for which it stands.
    struct Circle {
        float radius = 0.0f;
        float half_width_per_radius = 0.0f;
        // What h chi is weighed by.
        float for_volume = 0.0f;
        float for_missing_swirl = 0.0f;
        float for_missing_inverse = 0.0f;
        // Of the burr.
        float rise = 0.0f;   // sqrt(R^2 - r^2)
        float slope = 0.0f;  // r / that
    };
    /// The inner loop; in the source, where vectors are at home.
    struct Kernel;

    TipDiscSums sums_plain(const FaceAtTip& face, bool is_whole) const noexcept;
    TipDiscSums sums_avx2(const FaceAtTip& face, bool is_whole) const noexcept;
    TipDiscSums sums(const FaceAtTip& face, bool is_whole) const noexcept;

    InstructionSet instructions_;
    double radius_voxels_ = 0.0;  // no burr yet
    glm::vec3 direction_{0.0f, 0.0f, -1.0f};
    std::array<Circle, circles> circles_;
    alignas(64) std::array<float, angles> cosine_;
    alignas(64) std::array<float, angles> sine_;
};

}  // namespace osteomill
