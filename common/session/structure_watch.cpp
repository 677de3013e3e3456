#include "common/session/structure_watch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace osteomill {

namespace {

DistanceField field_of(const StructureMask& mask, double reach_mm, const std::string& name) {
    try {
        return {mask, reach_mm};
    } catch (const std::length_error&) {
        constexpr std::size_t mib = DistanceField::most_bricks * brick_voxel_count * 2 >> 20U;
        throw std::length_error(
            "tissue \"" + name + "\": the table of distances to it would take more than " +
            std::to_string(mib) + " MiB; protect less of it, import a smaller region or a coarser bone");
    }
}

}  // namespace

StructureWatch::StructureWatch(std::vector<Structure> structures, const std::vector<Tissue>& tissues,
                               const std::vector<Burr>& burrs) {
    if (structures.empty()) return;
    double largest_radius_mm = 0.0;
    for (const Burr& burr : burrs) {
        Head head{.clearance = BurrClearance(burr),
                  .profile = {},
                  .radius_mm = burr.radius_mm(),
                  .reach_mm = burr.radius_mm()};
        if (!burr.is_ball()) {
            head.profile.emplace(burr.head, burr.diameter_mm);
            head.reach_mm = std::hypot(head.profile->largest_radius(),
                                       std::max(-head.profile->tip_height(), head.profile->top_height()));
        }
        largest_radius_mm = std::max(largest_radius_mm, head.clearance.largest_radius_mm());
        heads_.push_back(std::move(head));
    }
    for (Structure& structure : structures) {
        const double watched = watched_mm(tissues[structure.tissue]);
        DistanceField field =
            field_of(structure.mask, watched + largest_radius_mm, tissues[structure.tissue].name);
        watched_.push_back({.mask = std::move(structure.mask),
                            .label = tissues[structure.tissue].label,
                            .field = std::move(field),
                            .watched_mm = watched,
                            .last_touch_s = -std::numeric_limits<double>::infinity()});
        watched_.back().account.last.tissue = structure.tissue;
    }
}

void StructureWatch::note(const BrickChange& change, BrickFractions before, BrickFractions after,
                          const ByteBrick* labels) {
    for (Watched& one : watched_) {
        const auto& bricks = one.mask.bricks();
        const auto brick = std::ranges::lower_bound(bricks, change.brick, {}, &StructureBrick::brick);
        const bool in_mask = brick != bricks.end() && brick->brick == change.brick;
        if (!in_mask && labels == nullptr) continue;
        std::int64_t lost = 0;
        change.voxels.for_each([&](std::size_t voxel) {
            if ((in_mask && brick->voxels[voxel]) || (labels != nullptr && (*labels)[voxel] == one.label))
                lost += int{before[voxel]} - int{after[voxel]};
        });
        if (change.kind == ChangeKind::restored) {
            one.restored_levels -= lost;
        } else if (lost > 0) {
            one.milled_levels += lost;
            one.was_milled = true;
        }
    }
}

void StructureWatch::update(const ToolState& tool) {
    if (watched_.empty()) return;
    const double dt_s = last_s_ ? std::max(0.0, tool.time_s - *last_s_) : 0.0;
    last_s_ = tool.time_s;
    distances_.clear();
    if (tool.time_s <= 0.0) return;
    for (Watched& one : watched_) {
        update(one, tool, dt_s);
        const StructureDistance& now = one.account.last;
        if (now.distance_mm || now.touches_so_far > 0) distances_.push_back(now);
    }
}

void StructureWatch::update(Watched& one, const ToolState& tool, double dt_s) const {
    const Head& head = heads_[tool.burr];
    const ToolPose pose{tool.burr_position_mm, tool.spindle_axis};
    StructureDistance& now = one.account.last;
    now.distance_mm = head.clearance.clearance_mm(one.field, pose);
    if (now.distance_mm && *now.distance_mm > one.watched_mm) now.distance_mm.reset();
    now.touches = std::exchange(one.was_milled, false) || (now.distance_mm && *now.distance_mm <= 0.0);
    if (now.touches) {
        if (tool.time_s > one.last_touch_s + touch_gap_s && now.touches_so_far++ == 0)
            now.first_touch_s = tool.time_s;
        one.last_touch_s = tool.time_s;
        now.touched_s += dt_s;
    }
    std::optional<double>& nearest = one.account.nearest_mm;
    if (now.distance_mm) nearest = std::min(nearest.value_or(*now.distance_mm), *now.distance_mm);
    // Between two states it was there.
    if (now.touches) nearest = std::min(nearest.value_or(0.0), 0.0);
    if (now.distance_mm && *now.distance_mm <= 0.0) enter(one, head, pose);

    const double mm3_per_voxel = voxel_volume_mm3(one.mask.grid());
    const auto mm3 = [&](std::int64_t levels) { return static_cast<double>(levels) / 255.0 * mm3_per_voxel; };
    now.removed_mm3 = std::max(0.0, mm3(one.milled_levels - one.restored_levels));
    now.entered_mm3 = static_cast<double>(one.entered_voxels) * mm3_per_voxel;
    one.account.given_back_mm3 = mm3(one.restored_levels);
}

void StructureWatch::enter(Watched& one, const Head& head, const ToolPose& pose) {
    const Grid& grid = one.mask.grid();
    const auto& bricks = one.mask.bricks();
    if (one.entered.empty()) one.entered.resize(bricks.size());
    const auto is_inside = [&](const glm::dvec3& place_mm) {
        const glm::dvec3 apart_mm = place_mm - pose.position_mm;
        if (!head.profile) return glm::dot(apart_mm, apart_mm) <= head.radius_mm * head.radius_mm;
        const double height_mm = glm::dot(apart_mm, pose.spindle_axis);
        const double radius_mm = glm::length(apart_mm - height_mm * pose.spindle_axis);
        return head.profile->nearest(radius_mm, height_mm).distance <= 0.0;
    };
    const glm::ivec3 size = size_in_bricks(grid);
    const glm::dvec3 low = to_voxel_coordinates(grid, pose.position_mm - head.reach_mm);
    const glm::dvec3 high = to_voxel_coordinates(grid, pose.position_mm + head.reach_mm);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, bricks[i].brick);
        if (glm::any(glm::greaterThan(glm::dvec3(first), high)) ||
            glm::any(glm::lessThan(glm::dvec3(first + (brick_edge_voxels - 1)), low)))
            continue;
        const VoxelMask rest = bricks[i].voxels.without(one.entered[i]);
        rest.for_each([&](std::size_t voxel) {
            if (!is_inside(centre_of_voxel_mm(grid, first + voxel_in_brick(voxel)))) return;
            one.entered[i].set(voxel);
            ++one.entered_voxels;
        });
    }
}

std::vector<StructureAccount> StructureWatch::accounts() const {
    std::vector<StructureAccount> all;
    for (const Watched& one : watched_) all.push_back(one.account);
    return all;
}

std::size_t StructureWatch::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Watched& one : watched_)
        bytes += one.mask.memory_bytes() + one.field.memory_bytes() + one.entered.size() * sizeof(VoxelMask);
    return bytes;
}

}  // namespace osteomill
