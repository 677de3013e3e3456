#include "common/bone/brick.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

namespace osteomill {

BrickTable::BrickTable() : BrickTable(std::span<const BrickIndex>{}) {}

BrickTable::BrickTable(std::span<const BrickIndex> brick_of_slot) {
    if (brick_of_slot.size() > std::size_t{std::numeric_limits<std::int32_t>::max()})
        throw std::invalid_argument("the bone has " + std::to_string(brick_of_slot.size()) +
                                    " bricks of 16^3 voxels, more than 2^31; crop it or coarsen it");
    const std::size_t places = std::bit_ceil(std::max<std::size_t>(2 * brick_of_slot.size(), 2));
    entries_.resize(places);
    shift_ = 64U - static_cast<unsigned>(std::countr_zero(places));
    for (std::size_t slot = 0; slot < brick_of_slot.size(); ++slot) {
        const BrickIndex brick = brick_of_slot[slot];
        std::size_t place = first_place(brick);
        while (entries_[place].slot != no_slot) {
            if (entries_[place].brick == brick)
                throw std::invalid_argument("brick " + std::to_string(brick) + " comes twice");
            place = (place + 1) & (places - 1);
        }
        entries_[place] = {brick, static_cast<std::int32_t>(slot)};
    }
}

}  // namespace osteomill
