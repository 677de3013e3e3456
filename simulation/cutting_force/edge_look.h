// Correction of the edge force for the distance ahead at which it is sampled. Edges rub on the burr's present
// face, but voxels show a face only over a sampled path ahead of the burr, a voxel long or more
// (chip_force.h): the face that the burr will have half-way along it. For a burr that dives that face is
// larger, by half in a shallow cut, and is met half a voxel early. So a path of half the length is sampled,
// too, and the line through the two forces leads to the face in the middle of the step:
//
//     F = F_1 + a b (F_h - F_1)             F_1, F_h: force over the whole path and over its first half
//     a = 2 (1 - step / path)               how far the line is followed
//     b = g^2 / (g^2 + q^2)                 g: growth of the volume that would go, <V_1 - 2 V_h>
//     q^2 = ((0.04 V_h)^2 + (1 voxel)^2) / (1 + (2 pi s)^2)      growth that is the lattice's
//
// Rows of the lattice enter half a path unevenly: along a surface its volume is off by a fiftieth, or by a
// voxel in a thin cut, and then b leaves the force over the whole path as it is. A face that grows slowly
// is told from that by the mean <> of its growth over the way s that the burr has gone in bone, up to half a
// voxel. If the line ends before there is a face, the burr has not reached the bone, and nothing rubs.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <numbers>

namespace osteomill {

/// Edge force over a path ahead, in a unit that both paths share, and the bone that would go.
struct EdgeLook {
    glm::dvec3 force{0.0};
    double voxels = 0.0;
};

/// Follows a burr's edges from step to step.
class EdgeGrowth {
  public:
    /// Correction to add to the force over the whole path, `look_voxels` long. `step_voxels`: length of the
    /// step, above 0; as long as the look, and the correction is zero. Real-time safe.
    glm::dvec3 correction(const EdgeLook& whole, const EdgeLook& half, double step_voxels,
                          double look_voxels) noexcept {
        constexpr double uneven_share = 0.04;
        constexpr double uneven_voxels = 1.0;
        const double follow = 2.0 * (1.0 - step_voxels / look_voxels);
        if (follow <= 0.0 || whole.voxels <= 0.0) return glm::dvec3(0.0);
        const double now = whole.voxels - 2.0 * half.voxels;
        grown_ += step_voxels / (gone_voxels_ + step_voxels) * (now - grown_);
        const double turn = 2.0 * std::numbers::pi * gone_voxels_;
        gone_voxels_ = std::min(gone_voxels_ + step_voxels, memory_voxels);
        const double uneven = uneven_share * half.voxels;
        const double uneven_squared = (uneven * uneven + uneven_voxels * uneven_voxels) / (1.0 + turn * turn);
        const double by = follow * grown_ * grown_ / (grown_ * grown_ + uneven_squared);
        return whole.voxels - by * now > 0.0 ? by * (half.force - whole.force) : -whole.force;
    }
    /// The burr left the bone, or jumped.
    void forget() noexcept { *this = EdgeGrowth{}; }

    static constexpr double memory_voxels = 0.5;

  private:
    double grown_ = 0.0;        // mean of V_1 - 2 V_h
    double gone_voxels_ = 0.0;  // over so long a way
};

}  // namespace osteomill
