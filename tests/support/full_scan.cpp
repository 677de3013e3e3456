#include "tests/support/full_scan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/scene/burr_frame.h"
#include "simulation/carving/crescent_rows.h"
#include "simulation/cutting_force/mean_force.h"

namespace osteomill::study {

namespace {

/// A voxel of the tool, counted from the voxel nearest to its centre.
struct ToolVoxel {
    glm::ivec3 offset;
    float distance_voxels;
};

/// Every voxel within `reach` voxels, nearest first.
std::vector<ToolVoxel> tool_voxels(double reach) {
    std::vector<ToolVoxel> voxels;
    const auto last = static_cast<int>(std::ceil(reach));
    for (int z = -last; z <= last; ++z)
        for (int y = -last; y <= last; ++y)
            for (int x = -last; x <= last; ++x) {
                const glm::ivec3 offset(x, y, z);
                const double distance = glm::length(glm::dvec3(offset));
                if (distance <= reach) voxels.push_back({offset, static_cast<float>(distance)});
            }
    std::stable_sort(voxels.begin(), voxels.end(), [](const ToolVoxel& a, const ToolVoxel& b) {
        return a.distance_voxels < b.distance_voxels;
    });
    return voxels;
}

/// Bone that the tool met, lowered a batch at a time.
template <typename Force>
class MetBone {
  public:
    MetBone(Bone& bone, const Sweep& sweep, const glm::ivec3& base, VoxelCoverage coverage, Force& force)
        : bone_(bone), sweep_(sweep, glm::dvec3(base), coverage), force_(force) {
        met_.base = base;
    }

    void add(const glm::ivec3& voxel, std::int32_t slot) {
        if (met_.count == RemovedVoxels::capacity) lower();
        const std::size_t n = met_.count++;
        const glm::vec3 from_base(voxel - met_.base);
        met_.x[n] = from_base.x;
        met_.y[n] = from_base.y;
        met_.z[n] = from_base.z;
        met_.slot[n] = slot;
        met_.offset[n] = static_cast<std::int32_t>(offset_in_brick(voxel));
    }

    void lower() {
        met_.pad();
        const std::size_t padded = met_.padded_count();
        levels_left(sweep_, {met_.x.data(), padded}, {met_.y.data(), padded}, {met_.z.data(), padded},
                    {left_.data(), padded}, InstructionSet::plain);
        const std::size_t met_count = std::exchange(met_.count, 0);
        for (std::size_t i = 0; i < met_count; ++i) {
            std::uint8_t& fraction = bone_.fractions(met_.slot[i])[static_cast<std::size_t>(met_.offset[i])];
            if (left_[i] >= fraction) continue;
            const int levels = fraction - left_[i];
            fraction = static_cast<std::uint8_t>(left_[i]);
            const std::size_t n = met_.count++;  // never past i: what was removed moves to the front
            met_.x[n] = met_.x[i];
            met_.y[n] = met_.y[i];
            met_.z[n] = met_.z[i];
            met_.levels[n] = static_cast<float>(levels);
            met_.slot[n] = met_.slot[i];
            met_.offset[n] = met_.offset[i];
            const glm::ivec3 voxel = met_.base + glm::ivec3(glm::vec3(met_.x[n], met_.y[n], met_.z[n]));
            weights_[n] = static_cast<float>(levels / 255.0 * bone_.stiffness_at(voxel));
            removed_levels_ += levels;
        }
        met_.pad();
        for (std::size_t i = met_.count; i < met_.padded_count(); ++i) weights_[i] = 0.0f;
        const std::span<const float> weights(weights_.data(), met_.padded_count());
        if (met_.count > 0) force_.add(met_, weights);
        met_.count = 0;
    }

    double removed_levels() const { return removed_levels_; }

  private:
    Bone& bone_;
    SweepSeenFrom sweep_;
    Force& force_;
    double removed_levels_ = 0.0;
    RemovedVoxels met_;
    alignas(64) std::array<std::int32_t, RemovedVoxels::capacity> left_;
    alignas(64) std::array<float, RemovedVoxels::capacity> weights_;
};

class FullScan final : public StudiedModel {
  public:
    FullScan(Bone bone, const Burr& burr, const MillingSettings& settings)
        : bone_(std::move(bone)),
          burr_(burr),
          settings_(settings),
          radius_voxels_(burr.radius_mm() / bone_.grid().spacing_mm),
          tool_(tool_voxels(radius_voxels_ + rim_voxels(settings.coverage) + 1.0 +
                            0.5 * CrescentRows::longest_step_voxels)),
          chips_(settings.bins) {
        if (settings.summation == ForceSummation::instants)
            throw std::invalid_argument("the full scan sums over voxels or bins, not over instants");
    }

    StepOutcome step(const BurrCommand& command) override {
        StepOutcome outcome;
        if (command.spindle_on) {
            const glm::dvec3 from = has_position_ ? position_mm_ : command.pose.position_mm;
            const Sweep sweep{to_voxel_coordinates(bone_.grid(), from),
                              to_voxel_coordinates(bone_.grid(), command.pose.position_mm), radius_voxels_};
            const CuttingStep cutting(burr_, command.pose.spindle_axis, 0.5 * (sweep.from + sweep.to),
                                      bone_.grid().spacing_mm, command.elapsed_s);
            if (settings_.summation == ForceSummation::bins) {
                chips_.begin_step(burr_, cutting);
                outcome = mill(sweep, cutting, chips_);
            } else {
                MeanForce force(cutting, InstructionSet::plain);
                outcome = mill(sweep, cutting, force);
            }
        }
        position_mm_ = command.pose.position_mm;
        has_position_ = true;
        return outcome;
    }

    const Bone& bone() const override { return bone_; }

  private:
    /// A long sweep is a chain of short ones, as in carve(): a tool that is only put down at the step's end
    /// would leave ridges.
    template <typename Force>
    StepOutcome mill(const Sweep& sweep, const CuttingStep& cutting, Force& force) {
        const glm::dvec3 along = sweep.to - sweep.from;
        const double parts = std::max(1.0, std::ceil(glm::length(along) / CrescentRows::longest_step_voxels));
        glm::dvec3 from = sweep.from;
        double levels = 0.0;
        for (double part = 1.0; part <= parts; part += 1.0) {
            const glm::dvec3 to = part == parts ? sweep.to : sweep.from + along * (part / parts);
            levels += scan({from, to, sweep.radius}, cutting, force);
            from = to;
        }
        return {force.force_n(), levels / 255.0 * voxel_volume_mm3(bone_.grid())};
    }

    template <typename Force>
    double scan(const Sweep& sweep, const CuttingStep& cutting, Force& force) {
        const glm::dvec3 middle = 0.5 * (sweep.from + sweep.to);
        const glm::ivec3 centre(glm::round(middle));
        const double reach =
            sweep.radius + rim_voxels(settings_.coverage) + 0.5 * glm::length(sweep.to - sweep.from);
        const double to_centre = glm::length(middle - glm::dvec3(centre));
        const glm::dmat3 into_burr_frame = glm::transpose(cutting.frame);
        const auto base = centre - static_cast<int>(std::ceil(reach)) - 2;
        MetBone<Force> met(bone_, sweep, base, settings_.coverage, force);
        for (const ToolVoxel& tool : tool_) {
            if (tool.distance_voxels > reach + to_centre) break;
            const glm::ivec3 voxel = centre + tool.offset;
            const glm::dvec3 in_burr = into_burr_frame * (glm::dvec3(voxel) - middle);
            if (glm::dot(in_burr, in_burr) > reach * reach) continue;
            if (!contains(bone_.grid(), voxel)) continue;
            const std::int32_t slot = bone_.slot(voxel >> 4);
            if (slot == BoneContent::no_slot || bone_.fractions(slot)[offset_in_brick(voxel)] == 0) continue;
            met.add(voxel, slot);
        }
        met.lower();
        return met.removed_levels();
    }

    Bone bone_;
    Burr burr_;
    MillingSettings settings_;
    double radius_voxels_;
    std::vector<ToolVoxel> tool_;
    BinnedForce chips_;
    bool has_position_ = false;
    glm::dvec3 position_mm_{0.0};
};

}  // namespace

MakeModel full_scan_model(const MillingSettings& settings) {
    return [settings](Bone bone, const Burr& burr) {
        return std::make_unique<FullScan>(std::move(bone), burr, settings);
    };
}

std::size_t tool_voxel_count(const Burr& burr, double voxel_mm) {
    return tool_voxels(burr.radius_mm() / voxel_mm).size();
}

}  // namespace osteomill::study
