#include "haptic_server/program/scene_on_bone.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <optional>

#include "haptic_server/imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// Calls `visit(voxel)` for every voxel of which at least half is left.
template <typename Visit>
void for_each_solid_voxel(const Bone& bone, Visit&& visit) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        const glm::ivec3 first =
            brick_position(bone.content().size_bricks, bone.content().brick_of_slot[slot]) *
            brick_edge_voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            if (fractions[offset] < 128) continue;
            visit(first + voxel_in_brick(offset));
        }
    }
}

std::optional<glm::ivec3> highest_in_the_middle(const Bone& bone) {
    glm::ivec3 low(std::numeric_limits<int>::max());
    glm::ivec3 high(std::numeric_limits<int>::min());
    for_each_solid_voxel(bone, [&](const glm::ivec3& voxel) {
        low = glm::min(low, voxel);
        high = glm::max(high, voxel);
    });
    if (high.x < low.x) return std::nullopt;
    const glm::dvec3 middle = 0.5 * glm::dvec3(low + high);
    const glm::dvec3 quarter = 0.25 * glm::dvec3(high - low) + 0.5;
    std::optional<glm::ivec3> highest;
    for_each_solid_voxel(bone, [&](const glm::ivec3& voxel) {
        const glm::dvec3 off = glm::abs(glm::dvec3(voxel) - middle);
        if (off.x <= quarter.x && off.y <= quarter.y && (!highest || voxel.z > highest->z)) highest = voxel;
    });
    return highest;
}

}  // namespace

Scene scene_of_bone_file(const std::filesystem::path& file) {
    Scene scene = phantom_scene("tooth");
    scene.name = file.stem().string();
    scene.bone = FileSource{.path = file};
    scene.tissues.clear();
    scene.plan.reset();
    return scene;
}

void place_on_bone(Scene& scene, const Bone& bone) {
    constexpr double start_above_mm = 3.0;
    const std::optional<glm::ivec3> top = highest_in_the_middle(bone);
    if (!top) return;
    const glm::dvec3 mouth_mm = centre_of_voxel_mm(bone.grid(), *top);
    const double burr_radius_mm = scene.burrs[scene.start_burr].radius_mm();
    scene.start_pose = {mouth_mm + glm::dvec3(0.0, 0.0, start_above_mm + burr_radius_mm), {0.0, 0.0, 1.0}};
    scene.trajectory.start_mm = mouth_mm;
}

}  // namespace osteomill
