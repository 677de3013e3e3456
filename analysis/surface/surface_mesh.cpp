#include "analysis/surface/surface_mesh.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace osteomill {

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using Leaf = FloatGrid::TreeType::LeafNodeType;

constexpr double half = 127.5;
/// A fraction as near to one half as this becomes this far from it. A vertex may else lie so near a voxel's
/// centre that two of them are one as 32-bit numbers at a metre from the origin, which would leave triangles
/// without an area. Moves the surface by 0.014 voxels at most.
constexpr float nearest_to_half = 4.0F;

constexpr int leaf_edge = static_cast<int>(Leaf::DIM);
static_assert(brick_edge_voxels % leaf_edge == 0);

float field_at(float fraction) {
    const float from_half = fraction - static_cast<float>(half);
    if (fraction == 0.0F || std::abs(from_half) >= nearest_to_half) return fraction;
    return static_cast<float>(half) + std::copysign(nearest_to_half, from_half);
}

/// Adds the part of a brick that is one leaf of OpenVDB's tree.
void add_leaf(BrickFractions fractions, const glm::ivec3& corner_in_brick, const Coord& origin,
              FloatGrid& field) {
    const auto offset_of_row = [&](int y, int z) {
        return offset_in_brick(corner_in_brick + glm::ivec3(0, y, z));
    };
    bool is_empty = true;
    for (int z = 0; z < leaf_edge && is_empty; ++z)
        for (int y = 0; y < leaf_edge && is_empty; ++y) {
            const auto row = fractions.subspan(offset_of_row(y, z), leaf_edge);
            is_empty = std::all_of(row.begin(), row.end(), [](std::uint8_t f) { return f == 0; });
        }
    if (is_empty) return;
    Leaf& leaf = *field.tree().touchLeaf(origin);
    leaf.setValuesOn();
    float* values = leaf.buffer().data();
    for (int z = 0; z < leaf_edge; ++z)
        for (int y = 0; y < leaf_edge; ++y) {
            const std::size_t row = offset_of_row(y, z);
            for (int x = 0; x < leaf_edge; ++x)
                values[Leaf::coordToOffset(Coord(x, y, z))] =
                    field_at(fractions[row + static_cast<std::size_t>(x)]);
        }
}

/// The fractions, at whole coordinates the centres of voxels; zero around.
FloatGrid::Ptr field_of(const Bone& bone) {
    const FloatGrid::Ptr field = FloatGrid::create(0.0F);
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
        const glm::ivec3 first =
            brick_position(content.size_bricks, content.brick_of_slot[slot]) * brick_edge_voxels;
        for (int z = 0; z < brick_edge_voxels; z += leaf_edge)
            for (int y = 0; y < brick_edge_voxels; y += leaf_edge)
                for (int x = 0; x < brick_edge_voxels; x += leaf_edge)
                    add_leaf(fractions, {x, y, z}, Coord(first.x + x, first.y + y, first.z + z), *field);
    }
    return field;
}

/// The same with the mean over cells of so many voxels along each axis.
FloatGrid::Ptr coarse_field_of(const Bone& bone, int voxels_a_cell) {
    const FloatGrid::Ptr field = FloatGrid::create(0.0F);
    FloatGrid::Accessor cells = field->getAccessor();
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
        const glm::ivec3 first =
            brick_position(content.size_bricks, content.brick_of_slot[slot]) * brick_edge_voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            if (fractions[offset] == 0) continue;
            const glm::ivec3 cell = (first + voxel_in_brick(offset)) / voxels_a_cell;
            const Coord at(cell.x, cell.y, cell.z);
            cells.setValue(at, cells.getValue(at) + static_cast<float>(fractions[offset]));
        }
    }
    const auto voxels = static_cast<float>(voxels_a_cell) * static_cast<float>(voxels_a_cell) *
                        static_cast<float>(voxels_a_cell);
    for (auto value = field->beginValueOn(); value; ++value) value.setValue(field_at(*value / voxels));
    return field;
}

glm::vec3 area_vector(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const glm::vec3& a = mesh.points_mm[triangle[0]];
    return 0.5F * glm::cross(mesh.points_mm[triangle[1]] - a, mesh.points_mm[triangle[2]] - a);
}

/// In two, along the shorter diagonal. OpenVDB's order is clockwise from where the values are lower.
void add_quad(const openvdb::Vec4I& q, SurfaceMesh& mesh) {
    const auto length = [&](int a, int b) {
        return glm::distance(mesh.points_mm[q[a]], mesh.points_mm[q[b]]);
    };
    if (length(0, 2) <= length(1, 3)) {
        mesh.triangles.push_back({q[2], q[1], q[0]});
        mesh.triangles.push_back({q[3], q[2], q[0]});
    } else {
        mesh.triangles.push_back({q[3], q[1], q[0]});
        mesh.triangles.push_back({q[3], q[2], q[1]});
    }
}

}  // namespace

SurfaceMesh surface_of(const Bone& bone, int voxels_a_cell) {
    if (voxels_a_cell < 1) throw std::invalid_argument("a cell of a surface has at least one voxel");
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    {
        const FloatGrid::Ptr field =
            voxels_a_cell == 1 ? field_of(bone) : coarse_field_of(bone, voxels_a_cell);
        // OpenVDB's library has this function compiled, but not its class VolumeToMesh.
        openvdb::tools::volumeToMesh(*field, points, quads, half);
    }
    if (points.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("the surface has more points than a file can number");

    SurfaceMesh mesh;
    const Grid& grid = bone.grid();
    const double cell_mm = grid.spacing_mm * voxels_a_cell;
    const glm::dvec3 first_cell_mm = grid.origin_mm + 0.5 * (cell_mm - grid.spacing_mm);
    mesh.points_mm.reserve(points.size());
    for (const openvdb::Vec3s& voxel : points)
        mesh.points_mm.emplace_back(first_cell_mm + cell_mm * glm::dvec3(voxel.x(), voxel.y(), voxel.z()));
    points = {};
    mesh.triangles.reserve(2 * quads.size());
    for (const openvdb::Vec4I& quad : quads) add_quad(quad, mesh);
    return mesh;
}

std::vector<glm::vec3> vertex_normals(const SurfaceMesh& mesh) {
    std::vector<glm::vec3> normals(mesh.points_mm.size(), glm::vec3(0.0F));
    for (const auto& triangle : mesh.triangles) {
        const glm::vec3 area = area_vector(mesh, triangle);
        for (const std::uint32_t point : triangle) normals[point] += area;
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        // Sheets that cancel out each other leave no direction.
        normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
    return normals;
}

}  // namespace osteomill
