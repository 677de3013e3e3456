// Edges rub on the face that the burr has, but voxels show it only over a look ahead of the burr, a voxel
// long or more (chip_force.h): that is the face which the burr will have half a look ahead. A burr that dives
// has a larger one there, by half in a shallow cut, and meets it half a voxel early. So a look of half the
// length is taken, too, and the line through the two leads to the face in the middle of the step:
//
//     F = F_1 + a b (F_h - F_1)             F_1, F_h: force over the whole look and over its first half
//     a = 2 (1 - step / look)               how far the line is followed
//     b = g^2 / (g^2 + q^2)                 g: growth of the volume that would go, V_1 - 2 V_h
//     q^2 = (0.04 V_h)^2 + (1 voxel)^2      growth that is the lattice's
//
// Rows of the lattice enter half a look unevenly: along a surface its volume is off by a fiftieth, or by a
// voxel in a thin cut, and b leaves the whole look alone. Where the line ends before there is a face, the
// burr is still short of the bone, and nothing rubs.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

/// What edges rub on over a look ahead: the force, in a unit that both looks share, and the bone that would
/// go.
struct EdgeLook {
    glm::dvec3 force{0.0};
    double voxels = 0.0;
};

/// What is to be added to the force over the whole look. `step_share`: the step, as a share of the look; from
/// 1 on nothing is.
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
