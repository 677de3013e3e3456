// A copy of the bone that is kept equal to the server's by its state frames.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "common/wire/session_receiver.h"
#include "common/wire/tool_view.h"

namespace osteomill {

/// The bone after a frame is not what the server says that it is.
struct BoneDiffers {};

class BoneFollower {
  public:
    struct Applied {
        ToolView tool;
        bool is_verified = false;  ///< the frame stated a checksum, and it holds
    };

    /// `burr_count`: of the session, to check the tool against.
    BoneFollower(BoneArrived arrived, std::size_t burr_count)
        : bone_(std::move(arrived.bone)), checksum_(std::move(arrived.checksum)), burr_count_(burr_count) {}

    /// Appends the bricks that it changes to `dirty`. After an error part of the frame may have been applied:
    /// a fresh bone is needed.
    std::variant<Applied, BoneDiffers, WireError> apply(const v1::StateFrame& frame,
                                                        std::vector<BrickIndex>& dirty);

    const Bone& bone() const { return bone_; }
    std::uint64_t checksum() const { return checksum_.value(); }
    std::size_t burr_count() const { return burr_count_; }

    /// Gives a stored brick other fractions, as when a recording is wound back.
    void set_fractions(BrickIndex brick, std::span<const std::uint8_t, brick_voxel_count> fractions);

  private:
    Bone bone_;
    RunningChecksum checksum_;
    std::size_t burr_count_;
};

}  // namespace osteomill
