// The checksum of a bone that is being edited, kept up to date brick by brick: see checksum() in bone.h.
#pragma once

#include <cstdint>
#include <vector>

#include "common/bone/bone.h"

namespace osteomill {

class RunningChecksum {
  public:
    explicit RunningChecksum(const Bone& bone);

    /// To be called after the fractions of a stored brick have changed; `bone` is the one it began with.
    void update(const Bone& bone, std::int32_t slot);

    std::uint64_t value() const { return sum_; }

    /// The part of the checksum that `count` bricks from `first` on contribute, whether stored or not; `bone`
    /// is the one it began with.
    std::uint64_t sum_of(const Bone& bone, BrickIndex first, std::uint64_t count) const;

  private:
    std::vector<std::uint64_t> term_by_slot_;
    std::uint64_t sum_ = 0;
};

}  // namespace osteomill
