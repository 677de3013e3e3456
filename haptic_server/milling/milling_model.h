// The milling model behind the milling loop: owns the bone, moves the burr, removes bone, computes force and
// engagement. One thread at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/edit.h"
#include "common/scene/scene.h"
#include "haptic_server/milling/milling_step.h"

namespace osteomill {

class MillingModel {
  public:
    /// `burrs` and `tissues` as in the scene. Throws std::invalid_argument for an empty burr set or a burr
    /// whose values are not finite and positive.
    MillingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues);

    /// Moves the burr, carves what it passes through (only while the spindle is on), reports the edits and
    /// overwrites `result`. The first step, one with a different burr and one after `lift()` start at the
    /// command's pose without a sweep. A command that is not finite leaves bone and burr alone and yields
    /// zero force. Real-time safe.
    void step(const BurrCommand& command, double time_s, EditSink& edits, MillingResult& result) noexcept;

    /// The burr is somewhere else next time: no sweep from here to there.
    void lift() noexcept { has_pose_ = false; }

    const Bone& bone() const { return bone_; }
    const RemovedByTissue& removed_mm3() const { return removed_mm3_; }

  private:
    Bone bone_;
    std::vector<Burr> burrs_;
    std::array<bool, 256> protected_{};
    RemovedByTissue removed_mm3_{};
    ToolPose pose_;
    std::size_t burr_ = 0;
    std::uint64_t step_ = 0;
    bool has_pose_ = false;
};

}  // namespace osteomill
