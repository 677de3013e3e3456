// A cache of parts that many cases of the map share: the bone that they mill and the truth that they are
// judged against. Made when first asked for, kept for as long as the cache lives. Any number of threads; one
// that needs a scene in the making by another waits for it.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "common/bone/bone.h"
#include "studies/stability/map/map_case.h"
#include "studies/stability/map/scene_plan.h"
#include "studies/stability/map/truth.h"

namespace osteomill::study {

// The voxel bone of a scene: a homogeneous block, for the cutting scene with the slot that the burr has cut
// up to where it is put down.

inline constexpr double scene_voxel_mm = 0.1;
/// Farther off the truth than this a run has gone astray. The block reaches beyond it.
inline constexpr double astray_mm = 2.0;

/// `has_encoders`: the slot is cut, too, where an arm's encoders read the start, up to half a step deeper: a
/// burr that starts inside the bone is without force.
Bone scene_bone(const ScenePlan& plan, bool has_encoders);

/// Values by key, each made once.
template <typename Key, typename Value>
class MadeOnce {
  public:
    const Value& get(const Key& key, const std::function<Value()>& make) {
        std::promise<Value> made;
        std::shared_future<Value> value;
        bool is_mine = false;
        {
            const std::lock_guard lock(mutex_);
            const auto [place, is_new] = values_.try_emplace(key);
            if (is_new) place->second = made.get_future().share();
            is_mine = is_new;
            value = place->second;
        }
        if (is_mine) {
            try {
                made.set_value(make());
            } catch (...) {
                made.set_exception(std::current_exception());
            }
        }
        return value.get();  // lives in the map's shared state
    }

  private:
    std::mutex mutex_;
    std::map<Key, std::shared_future<Value>> values_;
};

class SceneCache {
  public:
    /// The references hold as long as the cache. `plan` is plan_of(c).
    const Bone& bone(const MapCase& c, const ScenePlan& plan);
    /// On an ideal device, whatever the case's: friction and encoders are not of the scene.
    const std::vector<TruthTick>& truth(const MapCase& c);

  private:
    /// rpm, depth, stiffness; all zero for the wall.
    using BoneKey = std::tuple<double, double, double, double>;
    /// Grip, whether the mount is rigid, the wall's stiffness (0: cutting), and the bone's.
    using TruthKey = std::tuple<MapGrip, bool, double, BoneKey>;

    static BoneKey bone_key(const MapCase& c);

    MadeOnce<std::pair<BoneKey, bool>, Bone> bones_;  // and whether the device is ideal
    MadeOnce<TruthKey, std::vector<TruthTick>> truths_;
};

}  // namespace osteomill::study
