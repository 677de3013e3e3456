#include "simulation/engagement/brick_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace osteomill {

BrickNeighbourhood::BrickNeighbourhood(double largest_radius_voxels)
    : edge_(static_cast<int>(std::ceil((2.0 * largest_radius_voxels + 2.0) / brick_edge_voxels)) + 1),
      slots_(static_cast<std::size_t>(edge_) * edge_ * edge_, BoneContent::no_slot),
      fractions_(slots_.size(), nullptr) {}

bool BrickNeighbourhood::gather(const Bone& bone, const glm::dvec3& centre_voxels,
                                double radius_voxels) noexcept {
    bone_ = &bone;
    const glm::dvec3 low = centre_voxels - radius_voxels;
    const glm::dvec3 high = centre_voxels + radius_voxels;
    const glm::dvec3 last_voxel(bone.grid().size_voxels - 1);
    if (glm::any(glm::lessThan(high, glm::dvec3(0.0))) || glm::any(glm::greaterThan(low, last_voxel)))
        return false;

    const glm::ivec3 first_brick = glm::ivec3(glm::floor(low)) >> 4;
    const glm::ivec3 end_brick =
        glm::min((glm::ivec3(glm::floor(high)) + 1) >> 4, first_brick + edge_ - 1) + 1;
    base_ = first_brick * brick_edge_voxels;
    const glm::ivec3 size = bone.content().size_bricks;
    bool any = false;
    for (int z = first_brick.z; z < end_brick.z; ++z)
        for (int y = first_brick.y; y < end_brick.y; ++y)
            for (int x = first_brick.x; x < end_brick.x; ++x) {
                const glm::ivec3 brick(x, y, z);
                const bool exists = x >= 0 && y >= 0 && z >= 0 && x < size.x && y < size.y && z < size.z;
                const std::int32_t slot = exists ? bone.slot(brick) : BoneContent::no_slot;
                const glm::ivec3 position = brick - first_brick;
                const auto at =
                    static_cast<std::size_t>(position.x + edge_ * (position.y + edge_ * position.z));
                slots_[at] = slot;
                fractions_[at] = slot == BoneContent::no_slot ? nullptr : bone.fractions(slot).data();
                any |= slot != BoneContent::no_slot;
            }
    return any;
}

double BrickNeighbourhood::stiffness(const glm::vec3& position) const {
    const glm::ivec3 nearest(position + 0.5f);
    const std::int32_t at = slot(nearest);
    return at == BoneContent::no_slot ? 0.0 : bone_->content().stiffness_in(at, offset_in_brick(nearest));
}

std::uint8_t BrickNeighbourhood::tissue(const glm::vec3& position) const {
    const glm::ivec3 nearest(position + 0.5f);
    const std::int32_t at = slot(nearest);
    return at == BoneContent::no_slot ? std::uint8_t{0}
                                      : bone_->content().tissue_in(at, offset_in_brick(nearest));
}

float BrickNeighbourhood::fraction(const glm::vec3& position) const {
    const glm::ivec3 first(position);
    const glm::vec3 w = position - glm::vec3(first);
    const std::uint64_t bytes = corners(first);
    std::array<float, 8> c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = static_cast<float>(bytes >> (8 * i) & 255u);
    return detail::trilinear(c, w.x, w.y, w.z);
}

std::uint64_t BrickNeighbourhood::corners_across(std::int32_t brick, std::int32_t in_brick) const {
    constexpr int last = brick_edge_voxels - 1;
    const bool across_x = (in_brick & last) == last;
    const bool across_y = (in_brick >> 4 & last) == last;
    const bool across_z = (in_brick >> 8) == last;
    std::uint64_t bytes = 0;
    for (int i = 0; i < 4; ++i) {
        // From the last voxel of an axis to the first of the next brick.
        std::int32_t at = in_brick;
        std::int32_t of = brick;
        if ((i & 1) != 0) {
            at += across_y ? -16 * last : 16;
            of += across_y ? edge_ : 0;
        }
        if ((i >> 1) != 0) {
            at += across_z ? -256 * last : 256;
            of += across_z ? edge_ * edge_ : 0;
        }
        std::uint64_t pair = 0;
        const std::uint8_t* const here = fractions_[static_cast<std::size_t>(of)];
        if (!across_x) {
            if (here != nullptr) pair = detail::pair_at(here + at);
        } else {
            const std::uint8_t* const next = fractions_[static_cast<std::size_t>(of) + 1];
            if (here != nullptr) pair = here[at];
            if (next != nullptr) pair |= std::uint64_t{next[at - last]} << 8;
        }
        bytes |= pair << (16 * i);
    }
    return bytes;
}

}  // namespace osteomill
