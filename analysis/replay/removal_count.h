// How much bone the edits of a recording take away, by tissue, less what is given back.
#pragma once

#include <array>
#include <cstdint>
#include <set>

#include "common/bone/bone.h"
#include "osteomill/v1/session.pb.h"

namespace osteomill {

/// Counted in whole levels of fraction, so nothing is lost to rounding. Around each state frame: before(),
/// the frame is applied, after().
class RemovalCount {
  public:
    /// Frames that make no sense are counted as far as they name stored bricks.
    void before(const Bone& bone, const v1::StateFrame& next);
    /// A second time it does nothing.
    void after(const Bone& bone);

    /// Index: tissue label; 0 holds what has none.
    std::array<double, 256> removed_mm3(const Grid& grid) const;

  private:
    std::set<std::int32_t> slots_;
    std::array<std::int64_t, 256> codes_{};
};

}  // namespace osteomill
