// The face of bone before a ball's tip, and what the force of chips and of edges lacks where that face ends
// near the spindle's axis.
//
// Near the axis a chip acts sideways as its thickness c times e_r / r, which is summed as a mean over a disc
// (axis_singularity_kernel.h). Where the face ends in a line, at the bone's surface or at a groove, the disc
// reaches over the line. With x across the line, n, away from the bone, the line at x = d from the axis, and
// p the disc's weight seen along the line,
//
//     integral of c e_r / r over the face, less its means = n (c_0 I_0(d) + c_1 I_1(d))
//     c = c_0 + c_1 x     I_k(d) = int_-a^d x^k b(x) dx     b(x) = pi (sign x - int sign(x - t) p(t) dt)
//
// Edges act likewise as the face itself, c = 1. So a face that ends at the axis itself lacks 0.82 voxels of
// its width, and one that ends within a voxel has up to 0.16 too much. The voxels before the tip tell where
// the line lies: of what a ball larger by a part of a voxel would remove from bone all about, some is
// missing. Its share, weighed by a disc, gives the distance of the line half-way to that ball's surface, and
// a straight line through the distances of two such balls leads back to the burr; its centre gives n.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "simulation/carving/sweep.h"
#include "simulation/carving/voxel_coverage.h"
#include "simulation/cutting_force/chip_force.h"

namespace osteomill {

/// Where the face before the tip ends.
struct FaceEnd {
    double distance_voxels = 0.0;  ///< d, negative if there is no bone at the axis
    /// n, burr axes, and as long as it is sure that what is missing lies on that side: 0, no line, to 1.
    glm::dvec2 across{0.0};
    double stiffness = 0.0;   ///< relative, of the bone there
    std::uint8_t tissue = 0;  ///< label of the most of it
};

class AxisFace {
  public:
    AxisFace();

    /// Looks at the bone before the tip of a ball that has carved at `ball.from` and goes to `ball.to`, voxel
    /// coordinates. `frame`: burr axes in patient axes. No line if the tip does not lead, the ball is smaller
    /// than smallest_radius_voxels, or `coverage` is binary. Real-time safe.
    FaceEnd look(const Bone& bone, const Sweep& ball, const glm::dmat3& frame,
                 VoxelCoverage coverage) const noexcept;

    /// The force that the chips or edges of `step` lack on the path of `ball`, N, burr axes. Real-time safe.
    glm::dvec3 lacking_n(const CuttingStep& step, const FaceEnd& end, const Sweep& ball) const noexcept;

    /// The disc would reach about half of a smaller one.
    static constexpr double smallest_radius_voxels = 4.0;

  private:
    static constexpr int cells = 128;
    using Table = std::array<double, cells + 1>;

    Table distance_{};  // by the share of the face that is there, 0 to 1
    // By the distance, over all that the look reaches.
    Table constant_{};  // I_0
    Table slope_{};     // I_1, less the share of what a face without an end has
    Table aside_{};     // of what is missing, from the axis, times its share
};

}  // namespace osteomill
