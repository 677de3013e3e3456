// Bone that the changes of a recording take away, by tissue, less what is given back.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"

namespace osteomill {

/// Counted in whole levels of fraction, so nothing is lost to rounding. Around each state frame: before(),
/// the frame is applied, after().
class RemovalCount {
  public:
    /// Changes of bricks that are not stored, which no bone takes, count for nothing.
    void before(const Bone& bone, const std::vector<ChangedBrick>& next);
    /// A second time it does nothing.
    void after(const Bone& bone);

    /// Index: tissue label; 0 holds what has none.
    std::array<double, 256> removed_mm3(const Grid& grid) const;

  private:
    std::set<std::int32_t> slots_;
    std::array<std::int64_t, 256> codes_{};
};

}  // namespace osteomill
