// Voxels that a ball overlaps, row by row of the stored bricks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "simulation/carving/sweep.h"

namespace osteomill {

/// A ball in voxel coordinates.
struct Ball {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};

/// Voxels of one row of one stored brick that may lie in a ball.
struct BallRow {
    std::int32_t slot;
    std::size_t row_offset;  ///< in its brick, of the row's voxel with x = 0
    glm::ivec3 first;        ///< voxel
    int count;               ///< 1 to 16, along x, within the brick
};

/// The part of a voxel that a ball covers, 0 to 1: clamp(1/2 + R - distance, 0, 1), as in voxel_coverage.h.
inline double cover_of(const Ball& ball, double distance_squared) {
    const double inner = ball.radius - 0.5;
    if (inner > 0.0 && distance_squared <= inner * inner) return 1.0;
    return std::clamp(0.5 + ball.radius - std::sqrt(distance_squared), 0.0, 1.0);
}

/// Calls `visit(const BallRow&)` for each row of a stored brick that comes within half a voxel of the ball
/// and is not empty, in a fixed order: so every voxel of which cover_of() is above zero and that holds bone.
/// Real-time safe if `visit` is.
template <typename Visit>
void visit_rows(const Bone& bone, const Ball& ball, Visit&& visit) {
    const double reach = ball.radius + 0.5;
    const glm::dvec3 last_voxel(bone.grid().size_voxels - 1);
    const glm::ivec3 low(glm::ceil(glm::clamp(ball.centre - reach, glm::dvec3(0.0), last_voxel + 1.0)));
    const glm::ivec3 high(glm::floor(glm::clamp(ball.centre + reach, glm::dvec3(-1.0), last_voxel)));
    if (low.x > high.x || low.y > high.y || low.z > high.z) return;

    glm::ivec3 brick;
    for (brick.z = low.z >> 4; brick.z <= high.z >> 4; ++brick.z)
        for (brick.y = low.y >> 4; brick.y <= high.y >> 4; ++brick.y)
            for (brick.x = low.x >> 4; brick.x <= high.x >> 4; ++brick.x) {
                const std::int32_t slot = bone.slot(brick);
                if (slot == BoneContent::no_slot) continue;
                const auto fractions = bone.fractions(slot);
                const glm::ivec3 corner = brick * brick_edge_voxels;
                const glm::ivec3 first = glm::max(low, corner);
                const glm::ivec3 last = glm::min(high, corner + (brick_edge_voxels - 1));
                for (int z = first.z; z <= last.z; ++z)
                    for (int y = first.y; y <= last.y; ++y) {
                        const std::size_t row_offset = offset_in_brick({0, y, z});
                        std::array<std::uint64_t, 2> halves;
                        std::memcpy(halves.data(), fractions.data() + row_offset, sizeof halves);
                        if ((halves[0] | halves[1]) == 0) continue;
                        const Interval hit = line_through_ball(ball.centre, reach, y, z);
                        if (hit.empty()) continue;
                        const int from = std::max(first.x, static_cast<int>(std::ceil(hit.first)));
                        const int to = std::min(last.x, static_cast<int>(std::floor(hit.last)));
                        if (from <= to) visit(BallRow{slot, row_offset, {from, y, z}, to - from + 1});
                    }
            }
}

/// Calls `visit(from_centre, cover, fraction, offset_in_brick, slot)` for each voxel that the ball covers in
/// part and that holds bone: the vector from the ball's centre to the voxel's, in voxels, both shares 0 to 1.
/// Real-time safe if `visit` is.
template <typename Visit>
void visit_immersed(const Bone& bone, const Ball& ball, Visit&& visit) {
    visit_rows(bone, ball, [&](const BallRow& row) {
        const auto fractions = bone.fractions(row.slot);
        const glm::dvec3 from_centre = glm::dvec3(row.first) - ball.centre;
        const double across_squared = from_centre.y * from_centre.y + from_centre.z * from_centre.z;
        const std::size_t offset = row.row_offset + static_cast<std::size_t>(row.first.x & 15);
        for (int i = 0; i < row.count; ++i) {
            const std::size_t at = offset + static_cast<std::size_t>(i);
            const std::uint8_t fraction = fractions[at];
            if (fraction == 0) continue;
            const double x = from_centre.x + i;
            const double cover = cover_of(ball, x * x + across_squared);
            if (cover <= 0.0) continue;
            visit(glm::dvec3(x, from_centre.y, from_centre.z), cover, fraction / 255.0, at, row.slot);
        }
    });
}

// Check for bone in a ball, the present burr or one that is to replace it.

/// Whether a voxel that is at least half there lies in the ball, all of it. Real-time safe; free air and
/// empty rows of voxels cost little.
bool has_bone_in(const Bone& bone, const Ball& ball) noexcept;

}  // namespace osteomill
