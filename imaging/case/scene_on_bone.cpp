#include "imaging/case/scene_on_bone.h"

#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "imaging/phantoms/phantom.h"
#include "simulation/force_models/ball_rows.h"

namespace osteomill {

namespace {

constexpr int half_voxel = 128;
constexpr double air_mm = 0.5;

/// Bricks that touch, as slots: pieces of bone, joined across gaps of less than a brick.
std::vector<std::vector<std::int32_t>> pieces_of(const Bone& bone) {
    const BoneContent& content = bone.content();
    std::vector<bool> is_known(bone.stored_bricks());
    std::vector<std::vector<std::int32_t>> pieces;
    for (std::size_t slot = 0; slot < is_known.size(); ++slot) {
        if (is_known[slot]) continue;
        is_known[slot] = true;
        std::vector<std::int32_t> piece{static_cast<std::int32_t>(slot)};
        for (std::size_t next = 0; next < piece.size(); ++next) {
            const glm::ivec3 brick = brick_position(
                content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(piece[next])]);
            const glm::ivec3 low = glm::max(brick - 1, glm::ivec3(0));
            const glm::ivec3 high = glm::min(brick + 1, content.size_bricks - 1);
            glm::ivec3 beside;
            for (beside.z = low.z; beside.z <= high.z; ++beside.z)
                for (beside.y = low.y; beside.y <= high.y; ++beside.y)
                    for (beside.x = low.x; beside.x <= high.x; ++beside.x) {
                        const std::int32_t other = bone.slot(beside);
                        if (other == BoneContent::no_slot || is_known[static_cast<std::size_t>(other)])
                            continue;
                        is_known[static_cast<std::size_t>(other)] = true;
                        piece.push_back(other);
                    }
        }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

/// Mean place and amount of bone.
struct Middle {
    glm::dvec3 sum_of_voxels{0.0};
    std::uint64_t voxels = 0;

    /// Adds the bone of a label, or all bone.
    void add(const Bone& bone, std::int32_t slot, std::optional<std::uint8_t> label) {
        const BrickFractions fractions = bone.fractions(slot);
        const BoneContent& content = bone.content();
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            if (fractions[offset] < half_voxel || (label && content.tissue_in(slot, offset) != *label))
                continue;
            sum_of_voxels += glm::dvec3(first + voxel_in_brick(offset));
            ++voxels;
        }
    }
    glm::dvec3 mean() const { return sum_of_voxels / static_cast<double>(voxels); }
};

/// The tool's target, in voxels: the middle of the plan's region, or of the largest piece of bone.
std::optional<glm::dvec3> looked_at(const Scene& scene, const Bone& bone) {
    const auto slots = static_cast<std::int32_t>(bone.stored_bricks());
    if (scene.plan) {
        if (const auto* sphere = std::get_if<SphereRegion>(&scene.plan->region))
            return to_voxel_coordinates(bone.grid(), sphere->centre_mm);
        if (const auto* cylinder = std::get_if<CylinderRegion>(&scene.plan->region))
            return to_voxel_coordinates(bone.grid(), 0.5 * (cylinder->from_mm + cylinder->to_mm));
        Middle target;
        for (const Tissue& tissue : scene.tissues)
            if (tissue.name == std::get<TissueRegion>(scene.plan->region).tissue)
                for (std::int32_t slot = 0; slot < slots; ++slot) target.add(bone, slot, tissue.label);
        if (target.voxels > 0) return target.mean();
    }
    Middle largest;
    for (const auto& piece : pieces_of(bone)) {
        Middle middle;
        for (const std::int32_t slot : piece) middle.add(bone, slot, std::nullopt);
        if (middle.voxels > largest.voxels) largest = middle;
    }
    if (largest.voxels == 0) return std::nullopt;
    return largest.mean();
}

/// The last bone along a direction from a place to the grid's edge.
struct WayOut {
    glm::dvec3 direction{0.0};
    double last_bone = 0.0;  ///< voxels from the place; 0: there is none on the way
    bool is_free = true;     ///< the bone ends before the grid does
};

WayOut way_out(const Bone& bone, const glm::dvec3& from, const glm::dvec3& direction) {
    constexpr double step = 0.5;
    constexpr double edge = 1.5;
    const glm::dvec3 last_voxel(bone.grid().size_voxels - 1);
    const auto is_within = [&](const glm::dvec3& at, double margin) {
        return glm::all(glm::greaterThanEqual(at, glm::dvec3(margin))) &&
               glm::all(glm::lessThanEqual(at, last_voxel - margin));
    };
    WayOut way{.direction = direction};
    for (double along = 0.0;; along += step) {
        const glm::dvec3 at = from + along * direction;
        if (!is_within(at, -0.5)) return way;
        if (bone.fraction_at(glm::ivec3(glm::round(at))) < half_voxel) continue;
        way.last_bone = along;
        way.is_free = is_within(at, edge);
    }
}

/// The shortest way to the end of the bone; of equals, upwards. A side on which the grid cuts through the
/// bone is chosen only if there is no other.
WayOut nearest_free_side(const Bone& bone, const glm::dvec3& from) {
    std::optional<WayOut> best;
    glm::ivec3 to;
    for (to.z = 1; to.z >= -1; --to.z)
        for (to.y = -1; to.y <= 1; ++to.y)
            for (to.x = -1; to.x <= 1; ++to.x) {
                if (to == glm::ivec3(0)) continue;
                const WayOut way = way_out(bone, from, glm::normalize(glm::dvec3(to)));
                constexpr double shorter = 1.0;  // voxels: what rounding alone may make
                const bool is_better =
                    !best || (way.is_free != best->is_free ? way.is_free
                                                           : way.last_bone < best->last_bone - shorter ||
                                                                 (to == glm::ivec3(0, 0, 1) &&
                                                                  way.last_bone < best->last_bone + shorter));
                if (is_better) best = way;
            }
    return *best;
}

/// To a micrometre: such numbers are for people.
glm::dvec3 rounded_mm(const glm::dvec3& place_mm) {
    return glm::round(1000.0 * place_mm) / 1000.0;
}

}  // namespace

Scene scene_of_bone_file(const std::filesystem::path& file) {
    Scene scene = phantom_scene("tooth");
    scene.name = file.stem().string();
    scene.description.clear();
    scene.bone = FileSource{.path = file};
    scene.tissues.clear();
    scene.plan.reset();
    return scene;
}

void place_on_bone(Scene& scene, const Bone& bone) {
    constexpr double start_above_mm = 3.0;
    const std::optional<glm::dvec3> place = looked_at(scene, bone);
    if (!place) return;
    const Grid& grid = bone.grid();
    const WayOut way = nearest_free_side(bone, *place);
    const double burr_radius_mm = scene.burrs[scene.start_burr].radius_mm();
    // Bone beside the way may reach further out than bone on it.
    double above_mm = start_above_mm;
    const auto start_mm = [&] {
        return grid.origin_mm + grid.spacing_mm * (*place + way.last_bone * way.direction) +
               (above_mm + burr_radius_mm) * way.direction;
    };
    const double farthest_mm = grid.spacing_mm * glm::length(glm::dvec3(grid.size_voxels));
    while (above_mm < farthest_mm && has_bone_in(bone, {to_voxel_coordinates(grid, start_mm()),
                                                        (burr_radius_mm + air_mm) / grid.spacing_mm}))
        above_mm += air_mm;
    scene.start_pose = {rounded_mm(start_mm()), way.direction};
    scene.trajectory.start_mm = rounded_mm(start_mm() - (above_mm + burr_radius_mm) * way.direction);
}

}  // namespace osteomill
