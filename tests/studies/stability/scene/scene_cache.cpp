#include "tests/studies/stability/scene/scene_cache.h"

#include "tests/studies/stability/scene/scene_bone.h"

namespace osteomill::study {

SceneCache::BoneKey SceneCache::bone_key(const MapCase& c) {
    if (c.scene == MapScene::wall) return {};
    return {c.spindle_rpm, c.depth_mm, c.relative_stiffness};
}

const Bone& SceneCache::bone(const MapCase& c, const ScenePlan& plan) {
    return bones_.get(bone_key(c), [&] { return scene_bone(plan); });
}

const std::vector<TruthTick>& SceneCache::truth(const MapCase& c, const ScenePlan& plan) {
    const TruthKey key{c.grip, plan.tool.coulomb_friction_n, plan.mount.is_rigid(), plan.wall_n_per_mm,
                       bone_key(c)};
    return truths_.get(key, [&] { return truth_of(plan); });
}

}  // namespace osteomill::study
