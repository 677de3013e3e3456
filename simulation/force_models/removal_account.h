// Account of the bone removed: by tissue and in all, in this step and since the start, and whether
// protected tissue was among it. Every contact model keeps its account here and so reports alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/scene.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

class RemovalAccount {
  public:
    /// For a bone whose voxels are as large as `grid` says, in a scene with these tissues.
    RemovalAccount(const Grid& grid, const std::vector<Tissue>& tissues)
        : mm3_per_level_(voxel_volume_mm3(grid) / 255.0) {
        for (const Tissue& tissue : tissues) protected_[tissue.label] = tissue.is_protected;
    }

    /// Numbers the step and clears the last step's values from `result`. Real-time safe.
    void begin_step(double time_s, MillingResult& result) noexcept {
        step_levels_ = 0.0;
        step_touches_protected_ = false;
        result.step = ++step_;
        result.time_s = time_s;
        result.force_n = glm::dvec3(0.0);
        result.removed_mm3 = 0.0;
        result.total_removed_mm3 = total_levels_ * mm3_per_level_;
        result.touches_protected = false;
        result.has_bone_inside = false;
        result.engagement.count = 0;
    }

    /// Bone of a tissue lost `levels` of a voxel's 255; a voxel that lost none is not touched. Real-time
    /// safe.
    void take(std::uint8_t tissue, double levels) noexcept {
        step_levels_ += levels;
        levels_[tissue] += levels;
        step_touches_protected_ |= levels > 0.0 && protected_[tissue];
    }

    /// Between steps: bone of a tissue gained `levels` of a voxel's 255 back, or lost them again (negative).
    /// Real-time safe.
    void restore(std::uint8_t tissue, double levels) noexcept {
        levels_[tissue] -= levels;
        total_levels_ -= levels;
    }

    /// Enters the step into the total and into `result`, with the burr's pose. Real-time safe.
    void end_step(const BurrCommand& command, MillingResult& result) noexcept {
        result.removed_mm3 = step_levels_ * mm3_per_level_;
        total_levels_ += step_levels_;
        result.total_removed_mm3 = total_levels_ * mm3_per_level_;
        result.touches_protected = step_touches_protected_;
        result.pose = command.pose;
        result.burr = command.burr;
        result.spindle_on = command.spindle_on;
    }

    double removed_mm3(std::size_t label) const { return levels_[label] * mm3_per_level_; }
    RemovedByTissue removed_mm3() const {
        RemovedByTissue removed = levels_;
        for (double& volume : removed) volume *= mm3_per_level_;
        return removed;
    }

  private:
    double mm3_per_level_;
    std::array<bool, 256> protected_{};
    // In levels, which are whole numbers, so that an undo leaves no remainder.
    std::array<double, 256> levels_{};  // by tissue
    double total_levels_ = 0.0;
    std::uint64_t step_ = 0;
    double step_levels_ = 0.0;
    bool step_touches_protected_ = false;
};

// Undo and redo in the milling loop's bone: milled bone is given back, or taken again.

/// Gives the voxels of the change their values in `fractions`, enters the difference into the account and
/// pushes the change as restored. A change that does not fit the bone has no effect. Real-time safe.
void restore_bone(const BrickChange& change, BrickFractions fractions, Bone& bone, RemovalAccount& account,
                  ChangeSink& changes) noexcept;

}  // namespace osteomill
