// Fractions left of a bone's voxels, brick by brick: plain, or shared.
//
// Plain bricks are in one block of their own, and a copy copies all of it. Shared bricks stay those of the
// bone that was shared; a brick is copied when it is first written to. So a copy of shared bricks copies only
// those written to since. The first write to a shared brick allocates, so real-time loops have plain ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/bone/brick.h"

namespace osteomill {

class FractionBricks {
  public:
    /// Plain.
    explicit FractionBricks(std::vector<ByteBrick> bricks);
    FractionBricks(const FractionBricks& other);
    FractionBricks(FractionBricks&&) noexcept = default;
    FractionBricks& operator=(FractionBricks other) noexcept;
    ~FractionBricks() = default;

    /// Shares the bricks from now on; copies share them, too. Copies no longer copy the bricks that it has by
    /// then.
    void share();

    std::size_t size() const { return places_.size(); }
    BrickFractions operator[](std::size_t slot) const { return *places_[slot]; }
    std::span<std::uint8_t, brick_voxel_count> to_write(std::size_t slot) {
        if (is_shared_ && lies_in_block(places_[slot])) make_own(slot);
        return *places_[slot];
    }

    /// Bricks that this object has for itself.
    std::size_t own_bricks() const { return is_shared_ ? own_.size() : places_.size(); }

  private:
    bool lies_in_block(const ByteBrick* brick) const {
        return std::less_equal<>()(block_->data(), brick) &&
               std::less<>()(brick, block_->data() + block_->size());
    }
    void make_own(std::size_t slot);

    std::shared_ptr<std::vector<ByteBrick>> block_;  // shared: written to by nobody
    bool is_shared_ = false;
    std::vector<std::pair<std::size_t, std::unique_ptr<ByteBrick>>> own_;  // by slot; of shared bricks
    std::vector<ByteBrick*> places_;                                       // by slot
};

}  // namespace osteomill
