#include "studies/stability/map/scene_cache.h"

#include "studies/stability/map/scene_bone.h"

namespace osteomill::study {

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

}  // namespace osteomill::study
