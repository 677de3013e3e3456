// Ways to sum the forces of the bone that a step removed into the force on the burr.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "haptic_server/milling/chip_force.h"

namespace osteomill {

/// The mean over a step: equation (2), directly over voxels. Real-time safe.
class CuttingForce {
  public:
    /// Of voxels as they are, however the burr moves.
    CuttingForce(const CuttingStep& step, InstructionSet instructions) noexcept
        : step_(step), instructions_(instructions) {}

    /// Puts right what `tip` shows, which has begun the step and outlives this.
    CuttingForce(const CuttingStep& step, InstructionSet instructions, TipEdge& tip) noexcept
        : step_(step), instructions_(instructions), tip_(&tip) {}

    /// `weights`: relative stiffness times the fraction removed, padded with zeros like the batch. Voxels of
    /// no bone, which onsets.h makes up, show no edge.
    void add(const RemovedVoxels& removed, std::span<const float> weights) noexcept {
        if (!tip_ || !tip_->search().is_on || !removed.bone) {
            sum_ += sum_of_chip_forces(step_, removed, weights, instructions_);
            return;
        }
        const ChipSums sums = sum_of_chip_forces(step_, removed, weights, instructions_, tip_->search());
        sum_ += sums.force;
        tip_->add(sums.tip);
    }

    /// Mean force of the bone on the burr during the step, N, patient axes. Asked once, when all of the step
    /// is added.
    glm::dvec3 force_n() noexcept {
        const glm::dvec3 at_tip =
            tip_ ? tip_->evened() + force_at_tip(step_, tip_->end_step()) : glm::dvec3(0.0);
        return step_.frame * (step_.newton_per_unit * (sum_ + at_tip));
    }

  private:
    CuttingStep step_;
    InstructionSet instructions_;
    TipEdge* tip_ = nullptr;
    glm::dvec3 sum_{0.0};
};

}  // namespace osteomill
