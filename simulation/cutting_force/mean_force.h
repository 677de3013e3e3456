// Mean milling force over a step: equation (2) summed directly over the removed voxels, the default.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "common/bone/bone.h"
#include "simulation/carving/removed_voxels.h"
#include "simulation/cutting_force/chip_force.h"

namespace osteomill {

// Weight of each removed voxel in the force: relative stiffness times the fraction that it lost.

/// Relative stiffness times the fraction that each voxel lost; zero for padding. `weights` has space for
/// removed.padded_count(). Real-time safe.
inline void weigh_by_stiffness(const BoneContent& content, const RemovedVoxels& removed,
                               std::span<float> weights) noexcept {
    if (content.stiffness.empty()) {
        const auto per_code = static_cast<float>(content.homogeneous_stiffness / 255.0);
        for (std::size_t i = 0; i < removed.padded_count(); ++i) weights[i] = per_code * removed.levels[i];
        return;
    }
    const auto per_code = static_cast<float>(content.stiffness_per_code / 255.0);
    for (std::size_t i = 0; i < removed.count; ++i) {
        const ByteBrick& stiffness = content.stiffness[static_cast<std::size_t>(removed.slot[i])];
        weights[i] = per_code * static_cast<float>(stiffness[static_cast<std::size_t>(removed.offset[i])]) *
                     removed.levels[i];
    }
    for (std::size_t i = removed.count; i < removed.padded_count(); ++i) weights[i] = 0.0f;
}

/// Real-time safe.
class MeanForce {
  public:
    MeanForce(const CuttingStep& step, InstructionSet instructions) noexcept
        : step_(step), instructions_(instructions) {}

    /// Weights are padded with zeros like the batch.
    void add(const RemovedVoxels& removed, std::span<const float> weights) noexcept {
        sum_ += sum_of_chip_forces(step_, removed, weights, instructions_);
    }

    /// Adds the voxels on which `edges` of the same step rub.
    void add_edges(const CuttingStep& edges, const RemovedVoxels& rubbed,
                   std::span<const float> weights) noexcept {
        edges_n_ += edges.newton_per_unit * sum_of_chip_forces(edges, rubbed, weights, instructions_);
    }

    /// Force of the edges so far, N, burr axes.
    const glm::dvec3& edges_n() const noexcept { return edges_n_; }
    /// Adds a force that neither voxels nor edges showed, N, burr axes; after the edges.
    void correct(const glm::dvec3& by_n) noexcept { edges_n_ += by_n; }

    /// Mean force of the bone on the burr during the step, N, patient axes.
    glm::dvec3 force_n() const noexcept { return step_.frame * (step_.newton_per_unit * sum_ + edges_n_); }

  private:
    CuttingStep step_;
    InstructionSet instructions_;
    glm::dvec3 sum_{0.0};
    glm::dvec3 edges_n_{0.0};  // burr axes
};

}  // namespace osteomill
