#include "studies/stability/map/scene_cache.h"

#include <array>
#include <glm/common.hpp>
#include <memory>
#include <utility>

#include "common/bone/bone_builder.h"
#include "common/bone/brick_change.h"
#include "devices/simulated/hand_and_arm.h"
#include "simulation/force_models/milling_model.h"

namespace osteomill::study {

namespace {

constexpr double spare_mm = 0.5;

/// Every voxel of the box is full. Its faces lie on multiples of the voxel.
Bone full_block(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double relative_stiffness) {
    const glm::dvec3 first = glm::floor(low_mm / scene_voxel_mm + 1e-6);
    const glm::dvec3 last = glm::ceil(high_mm / scene_voxel_mm - 1e-6);
    const Grid grid{.size_voxels = glm::ivec3(last - first),
                    .spacing_mm = scene_voxel_mm,
                    .origin_mm = (first + 0.5) * scene_voxel_mm};
    return filled(BoneBuilder::homogeneous(grid, relative_stiffness, false), grid,
                  [](const glm::ivec3&) { return VoxelValues{.fraction = 255}; });
}

}  // namespace

SceneCache::BoneKey SceneCache::bone_key(const MapCase& c) {
    if (c.scene == MapScene::wall) return {};
    return {c.spindle_rpm, c.depth_mm, c.relative_stiffness, c.edge_n_per_mm};
}

const Bone& SceneCache::bone(const MapCase& c, const ScenePlan& plan) {
    return bones_.get({bone_key(c), c.is_ideal_device}, [&] { return scene_bone(plan, !c.is_ideal_device); });
}

const std::vector<TruthTick>& SceneCache::truth(const MapCase& c) {
    MapCase ideal = c;
    ideal.is_ideal_device = true;
    const double wall_n_per_mm = c.scene == MapScene::wall ? c.wall_n_per_mm : 0.0;
    const TruthKey key{c.grip, mount_of(c).is_rigid(), wall_n_per_mm, bone_key(c)};
    return truths_.get(key, [&] { return truth_of(plan_of(ideal)); });
}

Bone scene_bone(const ScenePlan& plan, bool has_encoders) {
    const double beside_mm = plan.burr.radius_mm() + astray_mm + spare_mm;
    const double travel_mm =
        plan.feed_mm_per_s * tick_s * static_cast<double>(plan.timing.guided + plan.timing.released());
    const double below_mm = plan.depth_mm + astray_mm + spare_mm;
    const glm::dvec3 low_mm(-beside_mm, -beside_mm, -below_mm);
    const glm::dvec3 high_mm(travel_mm + beside_mm, beside_mm, 0.0);
    Bone block = full_block(low_mm, high_mm, plan.relative_stiffness);
    if (plan.scene == MapScene::wall) return block;

    MillingModel model(std::move(block), {plan.burr}, {});
    const glm::dvec3 end_mm = guided_position_mm(plan, plan.timing.guided);
    const double step_mm = ArmModel{}.resolution_mm;
    const glm::dvec3 end_as_read_mm = has_encoders ? step_mm * glm::round(end_mm / step_mm) : end_mm;
    const std::array slot_mm{end_mm - glm::dvec3(2.0 * beside_mm, 0.0, 0.0), end_mm, end_as_read_mm};
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    for (const glm::dvec3& to_mm : slot_mm)
        model.step(
            {.pose = {.position_mm = to_mm}, .spindle_on = true, .elapsed_s = 1.0, .wants_engagement = false},
            0.0, changes, *result);
    return model.bone();
}

}  // namespace osteomill::study
