#include "simulation/carving/full_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "simulation/carving/crescent_rows.h"

namespace osteomill {

namespace {

constexpr std::int32_t unchanged = -1;

/// How far from a step's middle the burr reaches at most.
double longest_reach(double radius_voxels, VoxelCoverage coverage) {
    return radius_voxels + rim_voxels(coverage) + 0.5 * CrescentRows::longest_step_voxels;
}

}  // namespace

FullScan::FullScan(double radius_voxels, VoxelCoverage coverage)
    : radius_(radius_voxels), coverage_(coverage) {
    // The voxel nearest to the middle is less than one away from it.
    const double reach = longest_reach(radius_voxels, coverage) + 1.0;
    const auto last = static_cast<int>(std::ceil(reach));
    for (int z = -last; z <= last; ++z)
        for (int y = -last; y <= last; ++y)
            for (int x = -last; x <= last; ++x) {
                const glm::ivec3 offset(x, y, z);
                const double distance = glm::length(glm::dvec3(offset));
                if (distance <= reach) voxels_.push_back({offset, static_cast<float>(distance)});
            }
    std::stable_sort(voxels_.begin(), voxels_.end(), [](const BurrVoxel& a, const BurrVoxel& b) {
        return a.distance_voxels < b.distance_voxels;
    });
    bricks_across_ = 2 * last / brick_edge_voxels + 2;
    const auto bricks = static_cast<std::size_t>(bricks_across_ * bricks_across_ * bricks_across_);
    change_of_brick_.assign(bricks, unchanged);
    changes_.reserve(bricks);
}

std::size_t FullScan::voxel_count() const {
    return static_cast<std::size_t>(std::ranges::count_if(voxels_, [this](const BurrVoxel& voxel) {
        return voxel.distance_voxels <= radius_ + rim_voxels(coverage_);
    }));
}

void FullScan::mark_changed(const BoneContent& content, std::int32_t slot, std::size_t offset) noexcept {
    const BrickIndex brick = content.brick_of_slot[static_cast<std::size_t>(slot)];
    const glm::ivec3 from_first = brick_position(content.size_bricks, brick) - first_brick_;
    std::int32_t& number = change_of_brick_[static_cast<std::size_t>(
        from_first.x + bricks_across_ * (from_first.y + bricks_across_ * from_first.z))];
    if (number == unchanged) {
        number = static_cast<std::int32_t>(changes_.size());
        changes_.push_back({.brick = brick});  // there is space for all
    }
    changes_[static_cast<std::size_t>(number)].voxels.set(offset);
}

void FullScan::lower(Bone& bone, const SweepSeenFrom& sweep, const CarveSettings& settings,
                     RemovalSink& removed) noexcept {
    alignas(64) std::array<std::int32_t, RemovedVoxels::capacity> left;
    met_.pad();
    const std::size_t padded = met_.padded_count();
    levels_left(sweep, {met_.x.data(), padded}, {met_.y.data(), padded}, {met_.z.data(), padded},
                {left.data(), padded}, settings.instructions);
    const std::size_t met_count = std::exchange(met_.count, 0);
    for (std::size_t i = 0; i < met_count; ++i) {
        const auto offset = static_cast<std::size_t>(met_.offset[i]);
        const std::uint8_t fraction = std::as_const(bone).fractions(met_.slot[i])[offset];
        if (left[i] >= fraction) continue;
        const std::size_t n = met_.count++;  // never past i: removed voxels move to the front
        met_.levels[n] = static_cast<float>(fraction - left[i]);
        bone.fractions(met_.slot[i])[offset] = static_cast<std::uint8_t>(left[i]);
        met_.x[n] = met_.x[i];
        met_.y[n] = met_.y[i];
        met_.z[n] = met_.z[i];
        met_.slot[n] = met_.slot[i];
        met_.offset[n] = met_.offset[i];
        mark_changed(bone.content(), met_.slot[n], offset);
    }
    met_.pad();
    if (met_.count > 0) removed.take(met_);
    met_.count = 0;
}

void FullScan::carve_short(Bone& bone, const Sweep& ball, const glm::dmat3& burr_frame,
                           const CarveSettings& settings, ChangeSink& changes,
                           RemovalSink& removed) noexcept {
    const glm::dvec3 middle = 0.5 * (ball.from + ball.to);
    const glm::ivec3 centre(glm::round(middle));
    const double reach = radius_ + rim_voxels(coverage_) + 0.5 * glm::length(ball.to - ball.from);
    const double to_centre = glm::length(middle - glm::dvec3(centre));
    const glm::dmat3 into_burr_frame = glm::transpose(burr_frame);
    const auto last = static_cast<int>(std::ceil(longest_reach(radius_, coverage_) + 1.0));
    met_.base = centre - last;
    first_brick_ = met_.base >> 4;
    const SweepSeenFrom sweep(ball, glm::dvec3(met_.base), coverage_);
    const BoneContent& content = bone.content();
    for (const BurrVoxel& part : voxels_) {
        if (static_cast<double>(part.distance_voxels) > reach + to_centre) break;
        const glm::ivec3 voxel = centre + part.offset;
        const glm::dvec3 in_burr = into_burr_frame * (glm::dvec3(voxel) - middle);
        if (glm::dot(in_burr, in_burr) > reach * reach) continue;
        if (!contains(content.grid, voxel)) continue;
        const std::int32_t slot = bone.slot(voxel >> 4);
        if (slot == BoneContent::no_slot) continue;
        const std::size_t offset = offset_in_brick(voxel);
        if (std::as_const(bone).fractions(slot)[offset] == 0) continue;
        if (settings.uncut != nullptr && settings.uncut->of_label[content.tissue_in(slot, offset)]) continue;
        if (met_.count == RemovedVoxels::capacity) lower(bone, sweep, settings, removed);
        const std::size_t n = met_.count++;
        const glm::vec3 from_base(voxel - met_.base);
        met_.x[n] = from_base.x;
        met_.y[n] = from_base.y;
        met_.z[n] = from_base.z;
        met_.slot[n] = slot;
        met_.offset[n] = static_cast<std::int32_t>(offset);
    }
    lower(bone, sweep, settings, removed);
    for (const BrickChange& change : changes_)
        changes.push(change, std::as_const(bone).fractions(bone.slot(change.brick)));
    std::ranges::fill(change_of_brick_, unchanged);
    changes_.clear();
}

void FullScan::carve(Bone& bone, const Sweep& ball, const glm::dmat3& burr_frame,
                     const CarveSettings& settings, ChangeSink& changes, RemovalSink& removed) noexcept {
    Sweep sweep = ball;
    if (!cut_to_grid(sweep, bone.grid().size_voxels)) return;
    // A long sweep is a chain of short ones: a burr that is only put down at the step's end would leave
    // ridges.
    const glm::dvec3 along = sweep.to - sweep.from;
    const double parts = std::max(1.0, std::ceil(glm::length(along) / CrescentRows::longest_step_voxels));
    glm::dvec3 from = sweep.from;
    for (double part = 1.0; part <= parts; part += 1.0) {
        const glm::dvec3 to = part == parts ? sweep.to : sweep.from + along * (part / parts);
        carve_short(bone, {from, to, radius_}, burr_frame, settings, changes, removed);
        from = to;
    }
}

}  // namespace osteomill
