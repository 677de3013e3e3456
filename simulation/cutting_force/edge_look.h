// Correction of the edge force for the distance ahead at which it is sampled. Edges rub on the burr's present
// face, but voxels show a face only over a sampled path ahead of the burr, a voxel long or more
// (chip_force.h): the face that the burr will have half-way along it. For a burr that dives that face is
// larger, by half in a shallow cut, and is met half a voxel early. So a path of half the length is sampled,
// too, and the line through the two forces leads to the face in the middle of the step:
//
//     F = F_1 + a b (F_h - F_1)             F_1, F_h: force over the whole path and over its first half
//     a = 2 (1 - step / path)               how far the line is followed
//     b = g^2 / (g^2 + q^2)                 g: growth of the volume that would go, V_1 - 2 V_h
//     q^2 = (0.04 V_h)^2 + (1 voxel)^2      growth that is the lattice's
//
// Rows of the lattice enter half a path unevenly: along a surface its volume is off by a fiftieth, or by a
// voxel in a thin cut, and then b leaves the force over the whole path as it is. If the line ends before
// there is a face, the burr has not reached the bone, and nothing rubs.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

/// Edge force over a path ahead, in a unit that both paths share, and the bone that would go.
struct EdgeLook {
    glm::dvec3 force{0.0};
    double voxels = 0.0;
};

/// Correction to add to the force over the whole path. `step_share`: the step, as a share of that path; from
/// 1 on the correction is zero.
inline glm::dvec3 edge_look_correction(const EdgeLook& whole, const EdgeLook& half,
                                       double step_share) noexcept {
    constexpr double uneven_share = 0.04;
    constexpr double uneven_voxels = 1.0;
    const double follow = 2.0 * (1.0 - step_share);
    if (follow <= 0.0 || whole.voxels <= 0.0) return glm::dvec3(0.0);
    const double grown = whole.voxels - 2.0 * half.voxels;
    const double uneven = uneven_share * half.voxels;
    const double by =
        follow * grown * grown / (grown * grown + uneven * uneven + uneven_voxels * uneven_voxels);
    return whole.voxels - by * grown > 0.0 ? by * (half.force - whole.force) : -whole.force;
}

}  // namespace osteomill
