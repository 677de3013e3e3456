#include "common/wire/running_checksum.h"

#include <algorithm>
#include <numeric>

namespace osteomill {

RunningChecksum::RunningChecksum(const Bone& bone) : term_by_slot_(bone.stored_bricks(), 0) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        update(bone, static_cast<std::int32_t>(slot));
}

void RunningChecksum::update(const Bone& bone, std::int32_t slot) {
    const auto index = static_cast<std::size_t>(slot);
    const std::uint64_t term = checksum_of_brick(bone.content().brick_of_slot[index], bone.fractions(slot));
    sum_ += term - term_by_slot_[index];
    term_by_slot_[index] = term;
}

std::uint64_t RunningChecksum::sum_of(const Bone& bone, BrickIndex first, std::uint64_t count) const {
    const std::vector<BrickIndex>& bricks = bone.content().brick_of_slot;  // ascending
    const auto begin = std::lower_bound(bricks.begin(), bricks.end(), std::uint64_t{first});
    const auto end = std::lower_bound(begin, bricks.end(), first + count);
    return std::accumulate(term_by_slot_.begin() + (begin - bricks.begin()),
                           term_by_slot_.begin() + (end - bricks.begin()), std::uint64_t{0});
}

}  // namespace osteomill
