#include "simulation/force_models/erosion.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace osteomill {

namespace {

constexpr double steps_per_code = 65536.0;
/// Remainder that every voxel starts with, so that levels are rounded to the nearest rather than down.
constexpr std::uint16_t half_a_code = 32768;

int edge_around(double radius_voxels) {
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(2.0 * radius_voxels)) + 2u));
}

}  // namespace

Erosion::Erosion(double largest_radius_voxels)
    : edge_(edge_around(largest_radius_voxels)),
      remainders_(static_cast<std::size_t>(edge_) * edge_ * edge_, half_a_code) {}

void Erosion::erode(Bone& bone, const Ball& ball, double dose, ChangeSink& changes, ErosionSink& removed,
                    const UncutTissues& uncut) noexcept {
    const BoneContent& content = bone.content();
    // A dose of more than a whole voxel takes no more than the voxel.
    const double steps = std::min(dose, 1.0 / least_stiffness) * 255.0 * steps_per_code;
    BrickChange change;
    std::int32_t changed_slot = BoneContent::no_slot;
    const auto push_change = [&] {
        if (changed_slot != BoneContent::no_slot) changes.push(change, bone.fractions(changed_slot));
    };
    visit_rows(bone, ball, [&](const BallRow& row) {
        const auto fractions = bone.fractions(row.slot).subspan(row.row_offset, brick_edge_voxels);
        const glm::dvec3 from_centre = glm::dvec3(row.first) - ball.centre;
        const double across_squared = from_centre.y * from_centre.y + from_centre.z * from_centre.z;
        int changed_first = brick_edge_voxels;
        int changed_last = -1;
        for (int i = 0; i < row.count; ++i) {
            const int x_in_brick = (row.first.x & 15) + i;
            std::uint8_t& fraction = fractions[static_cast<std::size_t>(x_in_brick)];
            if (fraction == 0) continue;
            const double x = from_centre.x + i;
            const double cover = cover_of(ball, x * x + across_squared);
            if (cover <= 0.0) continue;
            const std::size_t offset = row.row_offset + static_cast<std::size_t>(x_in_brick);
            if (uncut.has_any && uncut.of_label[content.tissue_in(row.slot, offset)]) continue;
            const double stiffness = std::max(content.stiffness_in(row.slot, offset), least_stiffness);
            std::uint16_t& left_over = remainder(row.first + glm::ivec3(i, 0, 0));
            const std::uint64_t lost = left_over + static_cast<std::uint64_t>(steps * cover / stiffness);
            left_over = static_cast<std::uint16_t>(lost & 0xffffu);
            const int levels = static_cast<int>(std::min<std::uint64_t>(lost >> 16, fraction));
            if (levels == 0) continue;
            fraction = static_cast<std::uint8_t>(fraction - levels);
            changed_first = std::min(changed_first, x_in_brick);
            changed_last = x_in_brick;
            removed.take(row.slot, offset, levels);
        }
        if (changed_last < 0) return;
        if (row.slot != changed_slot) {
            push_change();
            changed_slot = row.slot;
            change = {.brick = content.brick_of_slot[static_cast<std::size_t>(row.slot)]};
        }
        // Voxels in between are included: a gap would cost more to send.
        change.voxels.set_run(row.row_offset + static_cast<std::size_t>(changed_first),
                              static_cast<std::size_t>(changed_last - changed_first + 1));
    });
    push_change();
}

}  // namespace osteomill
