// The surface of the remaining bone, as triangles.
//
// The surface is where the fraction, linear between the centres of voxels, is one half. It is made by
// OpenVDB's volumeToMesh: dual contouring, a vertex in each cell of eight neighbouring voxels that the
// surface passes through, at the mean of where it crosses the cell's edges; if a cell holds several sheets, a
// vertex for each. OpenVDB stores the fractions sparsely, so that memory follows the bricks that hold bone,
// not the grid.
//
// Closed: every edge belongs to exactly two triangles, which pass along it in opposite directions, whatever
// the fractions are and also if bone reaches the border of the grid. Normals (anticlockwise order) point
// out of the bone. On a sphere of 15 voxels' radius a vertex lies 0.02 voxels off in the mean. Bone thinner
// than two voxels in two directions becomes thinner still: a rod of one whole voxel keeps a quarter of its
// section.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"

namespace osteomill {

struct SurfaceMesh {
    std::vector<glm::vec3> points_mm;                     ///< patient LPS
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of points, anticlockwise from outside
};

/// Empty if nothing is left. `voxels_a_cell` along each axis become one, with the mean of their fractions:
/// fewer triangles, 1 / n^2 of them, and walls thinner than half a cell are lost. Throws std::runtime_error
/// for more points than 32 bits can number.
SurfaceMesh surface_of(const Bone& bone, int voxels_a_cell = 1);

/// Outward and of unit length, one for each point: the mean of the triangles around it, by area.
std::vector<glm::vec3> vertex_normals(const SurfaceMesh& mesh);

}  // namespace osteomill
