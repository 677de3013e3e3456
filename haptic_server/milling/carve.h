// Removes from the bone what a sweep of the burr passes through, and tells what went. Idempotent: the
// fraction of a voxel falls to at most one minus the part of it that the sweep covers, cover = clamp(1/2 + (R
// - distance) / h, 0, 1), so neither order nor number of steps matters and what a step removed is old minus
// new.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "common/bone/edit.h"
#include "haptic_server/milling/sweep.h"

namespace osteomill {

/// What a carve may take for granted about the bone.
enum class CarveHistory {
    none,           ///< nothing: every voxel of the sweep is looked at
    carved_at_from  ///< the same ball has already carved at `from`: only the crescent ahead of it can hold
                    ///< bone
};

/// The 255 steps of a fraction that a ball covering `cover` of a voxel leaves at most.
inline std::uint8_t fraction_left(double cover) {
    return static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - cover)));
}

namespace detail {

/// The range of whole x within `interval`, clipped to [0, size).
struct VoxelRange {
    int first = 0;
    int end = 0;
};

inline VoxelRange voxels_within(const Interval& interval, int size) {
    if (interval.empty()) return {};
    return {static_cast<int>(std::ceil(std::clamp(interval.first, 0.0, static_cast<double>(size)))),
            static_cast<int>(std::floor(std::clamp(interval.last, -1.0, size - 1.0))) + 1};
}

/// Carves voxels [first, end) of one row, brick by brick.
template <typename OnRemoved>
void carve_row(Bone& bone, const Sweep& ball, int y, int z, int first, int end, EditSink& edits,
               OnRemoved& on_removed) {
    const glm::dvec3 along = ball.to - ball.from;
    const double length_squared = glm::dot(along, along);
    const double inverse_length_squared = length_squared > 0.0 ? 1.0 / length_squared : 0.0;
    const double wy = y - ball.from.y;
    const double wz = z - ball.from.z;
    const double along_yz = wy * along.y + wz * along.z;

    for (int x = first; x < end;) {
        const int chunk_end = std::min(end, (x | 15) + 1);
        const glm::ivec3 brick(x >> 4, y >> 4, z >> 4);
        const std::int32_t slot = bone.slot(brick);
        if (slot == BoneContent::no_slot) {
            x = chunk_end;
            continue;
        }
        const std::size_t row = offset_in_brick({0, y, z});
        const auto fractions = bone.fractions(slot).subspan(row, brick_edge_voxels);
        int changed_first = 16;
        int changed_last = -1;
        for (; x < chunk_end; ++x) {
            const int i = x & 15;
            const std::uint8_t old = fractions[static_cast<std::size_t>(i)];
            if (old == 0) continue;
            const double wx = x - ball.from.x;
            const double t = std::clamp((wx * along.x + along_yz) * inverse_length_squared, 0.0, 1.0);
            const double dx = wx - t * along.x;
            const double dy = wy - t * along.y;
            const double dz = wz - t * along.z;
            const double cover =
                std::clamp(0.5 + ball.radius - std::sqrt(dx * dx + dy * dy + dz * dz), 0.0, 1.0);
            const std::uint8_t left = fraction_left(cover);
            if (left >= old) continue;
            fractions[static_cast<std::size_t>(i)] = left;
            changed_first = std::min(changed_first, i);
            changed_last = i;
            on_removed(glm::ivec3(x, y, z), static_cast<std::size_t>(slot), row + static_cast<std::size_t>(i),
                       old - left);
        }
        if (changed_last < 0) continue;
        EditRun run{.brick = bone.content().brick_of_slot[static_cast<std::size_t>(slot)],
                    .first_voxel = static_cast<std::uint16_t>(row + static_cast<std::size_t>(changed_first)),
                    .count = static_cast<std::uint8_t>(changed_last - changed_first + 1)};
        std::copy_n(fractions.begin() + changed_first, run.count, run.fraction.begin());
        edits.push(run);
    }
}

}  // namespace detail

/// Carves a sweep given in voxel coordinates (whole numbers are voxel centres, radius in voxels). Calls
/// `on_removed(voxel, slot, offset_in_brick, codes)` for each voxel that lost `codes` of its 255, in a fixed
/// order, and pushes an edit for each row of a brick that changed. Visits only stored bricks and, with
/// CarveHistory::carved_at_from, only the crescent between the two positions: not the ball's inside, and
/// nothing behind the plane through `from` across the motion, where the nearest point of the path is `from`
/// itself. Real-time safe if `on_removed` and `edits` are.
template <typename OnRemoved>
void carve(Bone& bone, const Sweep& ball, CarveHistory history, EditSink& edits, OnRemoved&& on_removed) {
    const glm::ivec3 size = bone.grid().size_voxels;
    const Sweep outer{ball.from, ball.to, ball.radius + 0.5};  // beyond it cover is 0
    const double inner_radius = ball.radius - 0.5;             // within it cover is 1
    const glm::dvec3 along = ball.to - ball.from;
    const bool crescent_only = history == CarveHistory::carved_at_from;
    if (crescent_only && along == glm::dvec3(0.0)) return;

    const auto range = [&](int axis) {
        return detail::voxels_within({std::min(ball.from[axis], ball.to[axis]) - outer.radius,
                                      std::max(ball.from[axis], ball.to[axis]) + outer.radius},
                                     size[axis]);
    };
    const detail::VoxelRange slices = range(2);
    const detail::VoxelRange rows = range(1);
    for (int z = slices.first; z < slices.end; ++z)
        for (int y = rows.first; y < rows.end; ++y) {
            Interval reach = line_through_sweep(outer, y, z);
            if (reach.empty()) continue;
            if (!crescent_only) {
                const detail::VoxelRange all = detail::voxels_within(reach, size.x);
                detail::carve_row(bone, ball, y, z, all.first, all.end, edits, on_removed);
                continue;
            }
            const double ahead_yz = (y - ball.from.y) * along.y + (z - ball.from.z) * along.z;
            if (along.x > 0.0)
                reach.first = std::max(reach.first, ball.from.x - ahead_yz / along.x);
            else if (along.x < 0.0)
                reach.last = std::min(reach.last, ball.from.x - ahead_yz / along.x);
            else if (ahead_yz <= 0.0)
                continue;
            const detail::VoxelRange all = detail::voxels_within(reach, size.x);
            const Interval inside =
                inner_radius > 0.0 ? line_through_ball(ball.from, inner_radius, y, z) : Interval{};
            const detail::VoxelRange skip = detail::voxels_within(inside, size.x);
            if (inside.empty() || skip.first >= skip.end) {
                detail::carve_row(bone, ball, y, z, all.first, all.end, edits, on_removed);
                continue;
            }
            detail::carve_row(bone, ball, y, z, all.first, std::min(all.end, skip.first), edits, on_removed);
            detail::carve_row(bone, ball, y, z, std::max(all.first, skip.end), all.end, edits, on_removed);
        }
}

}  // namespace osteomill
