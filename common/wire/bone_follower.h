// A copy of the bone that is kept equal to the server's by its state frames.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "common/wire/session_receiver.h"
#include "common/wire/tool_view.h"

namespace osteomill {

/// What the checksum of a frame shows of a copy.
enum class CopyCheck {
    none,     ///< the frame stated none
    equal,    ///< the copy has it
    differs,  ///< the copy has another
};

class BoneFollower {
  public:
    struct Applied {
        ToolView tool;
        CopyCheck check = CopyCheck::none;
        /// An edit raised what was left, as milling cannot: the copy had lost bone, and has it again.
        bool has_regained_bone = false;
    };

    /// `burr_count`: of the session, to check the tool against.
    BoneFollower(BoneArrived arrived, std::size_t burr_count)
        : bone_(std::move(arrived.bone)), checksum_(std::move(arrived.checksum)), burr_count_(burr_count) {}

    /// Appends the bricks that it changes to `dirty`. After an error part of the frame may have been applied:
    /// a fresh bone is needed.
    std::variant<Applied, WireError> apply(const v1::StateFrame& frame, std::vector<BrickIndex>& dirty);

    const Bone& bone() const { return bone_; }
    std::uint64_t checksum() const { return checksum_.value(); }
    const RunningChecksum& running_checksum() const { return checksum_; }
    std::size_t burr_count() const { return burr_count_; }

    /// Gives a stored brick other fractions, as when a recording is wound back.
    void set_fractions(BrickIndex brick, std::span<const std::uint8_t, brick_voxel_count> fractions);

  private:
    Bone bone_;
    RunningChecksum checksum_;
    std::size_t burr_count_;
};

}  // namespace osteomill
