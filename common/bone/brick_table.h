// Slot of each stored brick: a hash table that costs memory for bricks that are stored, not for the grid
// round them.
//
// Open addressing with linear probing, at most half full, so a look-up touches one cache line nearly always.
// Hash: Fibonacci's multiply-shift (Knuth, The Art of Computer Programming 3, 6.4), which spreads neighbours
// along a row as far apart as can be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/bone/brick.h"

namespace osteomill {

class BrickTable {
  public:
    static constexpr std::int32_t no_slot = -1;

    /// A table without bricks.
    BrickTable();
    /// The brick at each position has that position as its slot. Throws std::invalid_argument, naming it, for
    /// a brick that comes twice, and for more bricks than a slot can count (2^31).
    explicit BrickTable(std::span<const BrickIndex> brick_of_slot);

    /// Slot of a brick; no_slot for every other number. Real-time safe, from any number of threads.
    std::int32_t find(BrickIndex brick) const noexcept {
        for (std::size_t place = first_place(brick);; place = (place + 1) & (entries_.size() - 1)) {
            const Entry& entry = entries_[place];
            if (entry.brick == brick || entry.slot == no_slot) return entry.slot;
        }
    }

    std::size_t memory_bytes() const noexcept { return entries_.size() * sizeof(Entry); }

  private:
    struct Entry {
        BrickIndex brick = 0;
        std::int32_t slot = no_slot;  ///< no_slot: nothing is stored at this place
    };

    std::size_t first_place(BrickIndex brick) const noexcept {
        constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;  // 2^64 / ((1 + sqrt 5) / 2), odd
        return static_cast<std::size_t>((brick * golden_ratio) >> shift_);
    }

    std::vector<Entry> entries_;  // a power of two, at least 2
    unsigned shift_ = 0;          // leaves as many bits as number the places
};

}  // namespace osteomill
