#include "render_client/volume/structures/structure_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/bone/brick.h"
#include "common/bone/distance_field.h"

namespace osteomill {

namespace {

constexpr double most_mesh_voxels = 2e6;

}  // namespace

StructureMask region_about(const StructureMask& structure, double distance_mm) {
    const std::optional<VoxelBounds> bounds = structure.bounds();
    if (!bounds) return {};
    const double fine_mm = structure.grid().spacing_mm;
    const glm::dvec3 low_mm = centre_of_voxel_mm(structure.grid(), bounds->first);
    const glm::dvec3 across_mm = centre_of_voxel_mm(structure.grid(), bounds->last) - low_mm;
    Grid grid{.spacing_mm = fine_mm};
    for (;; grid.spacing_mm *= 1.1) {
        const double margin_mm = distance_mm + 2.0 * grid.spacing_mm;
        grid.origin_mm = low_mm - margin_mm;
        const glm::dvec3 size = glm::ceil((across_mm + 2.0 * margin_mm) / grid.spacing_mm) + 1.0;
        grid.size_voxels = glm::ivec3(size);
        if (size.x * size.y * size.z <= most_mesh_voxels) break;
    }
    const DistanceField field(structure, distance_mm + fine_mm);
    const glm::ivec3 size_bricks = size_in_bricks(grid);
    std::vector<StructureBrick> bricks;
    for (int z = 0; z < size_bricks.z; ++z)
        for (int y = 0; y < size_bricks.y; ++y)
            for (int x = 0; x < size_bricks.x; ++x) {
                const glm::ivec3 first = brick_edge_voxels * glm::ivec3(x, y, z);
                StructureBrick brick{.brick = brick_index(size_bricks, {x, y, z})};
                for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
                    const glm::ivec3 voxel = first + voxel_in_brick(offset);
                    if (!contains(grid, voxel)) continue;
                    const std::optional<float> found = field.distance_mm(centre_of_voxel_mm(grid, voxel));
                    if (found && *found <= distance_mm) brick.voxels.set(offset);
                }
                bricks.push_back(brick);
            }
    return {grid, std::move(bricks)};
}

namespace {

/// Estimate of vertices: a brick of a thin structure has a surface of some 256 cells.
constexpr double cells_per_brick = 256.0;
constexpr double most_cells = 400'000.0;
/// Least share of the structure in a coarse voxel: so small that a thin one does not vanish.
constexpr double least_part = 0.25;
constexpr int smoothing_steps = 8;

/// Most places along each axis in a key.
constexpr int most_places = 1 << 20;

std::uint64_t key_of(const glm::ivec3& place) {
    const auto part = [](int value) { return static_cast<std::uint64_t>(value + 1); };
    return part(place.x) | part(place.y) << 21U | part(place.z) << 42U;
}

glm::ivec3 place_of(std::uint64_t key) {
    const auto part = [&](unsigned shift) { return static_cast<int>(key >> shift & 0x1FFFFFU) - 1; };
    return {part(0), part(21), part(42)};
}

/// Number of voxels along each axis that become one.
int coarsening_of(const StructureMask& structure, const VoxelBounds& bounds) {
    const double cells = cells_per_brick * static_cast<double>(structure.bricks().size());
    const glm::ivec3 extent = bounds.last - bounds.first + 1;
    const int longest = std::max({extent.x, extent.y, extent.z});
    return std::max(static_cast<int>(std::ceil(std::sqrt(cells / most_cells))),
                    longest / (most_places - 2) + 1);
}

class SurfaceNet {
  public:
    /// Voxels of `edge` by `edge` by `edge`, counted from the structure's first.
    SurfaceNet(const StructureMask& structure, const VoxelBounds& bounds, int edge) {
        const glm::ivec3 size = size_in_bricks(structure.grid());
        std::vector<std::uint32_t> counts;  // of one brick's, so that each is looked up once
        for (const StructureBrick& brick : structure.bricks()) {
            const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick.brick) - bounds.first;
            const glm::ivec3 base = glm::max(first, 0) / edge;
            const int across = brick_edge_voxels / edge + 2;
            counts.assign(static_cast<std::size_t>(across * across * across), 0);
            brick.voxels.for_each([&](std::size_t offset) {
                const glm::ivec3 at = (first + voxel_in_brick(offset)) / edge - base;
                ++counts[static_cast<std::size_t>(at.x + across * (at.y + across * at.z))];
            });
            glm::ivec3 at;
            std::size_t next = 0;
            for (at.z = 0; at.z < across; ++at.z)
                for (at.y = 0; at.y < across; ++at.y)
                    for (at.x = 0; at.x < across; ++at.x)
                        if (const std::uint32_t count = counts[next++]; count > 0)
                            filled_[key_of(base + at)] += count;
        }
        const double least = least_part * edge * edge * edge;
        std::erase_if(filled_, [&](const auto& entry) { return entry.second < least; });
        for (const auto& entry : filled_) add_faces(place_of(entry.first));
        for (std::size_t i = 0; i < positions_.size(); ++i)
            positions_[i] /= static_cast<float>(crossings_[i]);
    }

    void smooth() {
        std::vector<glm::vec3> sums(positions_.size(), glm::vec3(0.0f));
        std::vector<float> counts(positions_.size(), 0.0f);
        for (const auto& quad : quads_)
            for (std::size_t k = 0; k < 4; ++k)
                for (const std::size_t other : {(k + 1) % 4, (k + 3) % 4}) {
                    sums[quad[k]] += positions_[quad[other]];
                    counts[quad[k]] += 1.0f;
                }
        for (std::size_t i = 0; i < positions_.size(); ++i)
            positions_[i] = glm::clamp(sums[i] / counts[i], glm::vec3(cells_[i]), glm::vec3(cells_[i] + 1));
    }

    /// Positions in these voxels, from the centre of the first.
    const std::vector<glm::vec3>& positions() const { return positions_; }
    const std::vector<std::array<std::uint32_t, 4>>& quads() const { return quads_; }

  private:
    void add_faces(const glm::ivec3& voxel) {
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1}) {
                glm::ivec3 step(0);
                step[axis] = side;
                if (!filled_.contains(key_of(voxel + step))) add_face(voxel, axis, side);
            }
    }

    /// Between the voxel and the empty one beside it, with a corner in each of the four cells round it.
    void add_face(const glm::ivec3& voxel, int axis, int side) {
        glm::ivec3 u(0), v(0);
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        glm::ivec3 cell = voxel;
        if (side < 0) cell[axis] -= 1;
        glm::vec3 middle(voxel);
        middle[axis] += 0.5f * static_cast<float>(side);
        std::array<std::uint32_t, 4> quad{corner(cell - u - v, middle), corner(cell - v, middle),
                                          corner(cell, middle), corner(cell - u, middle)};
        if (side < 0) std::swap(quad[1], quad[3]);
        quads_.push_back(quad);
    }

    std::uint32_t corner(const glm::ivec3& cell, const glm::vec3& crossing) {
        const auto [entry, is_new] =
            vertex_of_cell_.try_emplace(key_of(cell), static_cast<std::uint32_t>(cells_.size()));
        if (is_new) {
            cells_.push_back(cell);
            positions_.emplace_back(0.0f);
            crossings_.push_back(0);
        }
        positions_[entry->second] += crossing;
        ++crossings_[entry->second];
        return entry->second;
    }

    std::unordered_map<std::uint64_t, std::uint32_t> filled_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_cell_;
    std::vector<glm::ivec3> cells_;  // of each vertex: from this voxel's centre to the next
    std::vector<glm::vec3> positions_;
    std::vector<int> crossings_;
    std::vector<std::array<std::uint32_t, 4>> quads_;
};

}  // namespace

StructureMask soft_part(const StructureMask& structure, const Bone& bone) {
    const BoneContent& content = bone.content();
    std::vector<StructureBrick> bricks = structure.bricks();
    for (StructureBrick& brick : bricks) {
        const std::int32_t slot = bone.slot(brick.brick);
        if (slot == BoneContent::no_slot) continue;
        const BrickFractions fractions = bone.fractions(slot);
        VoxelMask bony;
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            if (fractions[voxel] > 0 ||
                (!content.stiffness.empty() && content.stiffness[static_cast<std::size_t>(slot)][voxel] > 0))
                bony.set(voxel);
        brick.voxels = brick.voxels.without(bony);
    }
    return {structure.grid(), std::move(bricks)};
}

StructureSurface surface_of(const StructureMask& structure, const glm::vec3& colour) {
    StructureSurface surface;
    const std::optional<VoxelBounds> bounds = structure.bounds();
    if (!bounds) return surface;
    const int edge = coarsening_of(structure, *bounds);
    SurfaceNet net(structure, *bounds, edge);
    for (int step = 0; step < smoothing_steps; ++step) net.smooth();

    const double spacing_mm = structure.grid().spacing_mm;
    surface.origin_mm = centre_of_voxel_mm(structure.grid(), bounds->first) + 0.5 * (edge - 1) * spacing_mm;
    std::vector<Vertex>& vertices = surface.triangles.vertices;
    for (const glm::vec3& position : net.positions())
        vertices.push_back({static_cast<float>(edge * spacing_mm) * position, glm::vec3(0.0f), colour});
    for (const auto& quad : net.quads()) {
        const glm::vec3 area = glm::cross(vertices[quad[2]].position - vertices[quad[0]].position,
                                          vertices[quad[3]].position - vertices[quad[1]].position);
        for (const std::uint32_t corner : quad) vertices[corner].normal += area;
        for (const std::size_t k : {0, 1, 2, 0, 2, 3}) surface.triangles.indices.push_back(quad[k]);
    }
    for (Vertex& vertex : vertices) {
        const float length = glm::length(vertex.normal);
        // Sheets that cancel each other out leave no direction.
        vertex.normal = length > 0.0f ? vertex.normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
    return surface;
}

}  // namespace osteomill
