// Changed voxels of one brick: the one type, from the carve to the picture, that says where the bone has
// changed.
//
// The new values are in a brick of fractions that goes with the change: the voxels of the mask hold the
// fraction that is left, all others any value. Values are absolute, so a later change overrides an earlier
// one, and a change may be applied twice.
//
// Milling only lowers fractions. Undo returns bone, and redo removes it again; such a change is marked as
// restored. A rise in any other change shows that the receiving copy was wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick.h"

namespace osteomill {

enum class ChangeKind : std::uint8_t {
    milled,    ///< no voxel rises
    restored,  ///< by undo, redo or a reset: any voxel may rise or fall
};

struct BrickChange {
    BrickIndex brick = 0;
    VoxelMask voxels{};
    ChangeKind kind = ChangeKind::milled;

    bool operator==(const BrickChange&) const = default;
};

/// A change with the fractions left of its voxels, on its way to another copy of the bone.
struct ChangedBrick {
    BrickChange change;
    ByteBrick fractions{};
};

/// Receiver of a milling step's changes; in a session the ChangeQueue (simulation/exchange/change_queue.h).
/// Real-time safe: never blocks, allocates or throws.
class ChangeSink {
  public:
    virtual ~ChangeSink() = default;
    /// `fractions`: of the change's brick, as they are now.
    virtual void push(const BrickChange& change, BrickFractions fractions) noexcept = 0;
};

/// For receivers that want the bone only.
class ForgottenChanges final : public ChangeSink {
  public:
    void push(const BrickChange&, BrickFractions) noexcept override {}
};

/// Writes the fractions of the change's voxels from `fractions`. False, with the bone unchanged, if the brick
/// is not stored, if milling would raise a voxel, or if a voxel beyond the grid's edge would rise.
[[nodiscard]] bool apply(const BrickChange& change, BrickFractions fractions, Bone& bone);

/// Outcome of a change in a copy of the bone that may be wrong.
enum class Correction {
    lowers,        ///< no voxel rose
    raises,        ///< some voxel rose
    not_stored,    ///< refused: no bone is stored in that brick
    outside_grid,  ///< refused: it puts bone into a part of the brick beyond the grid's edge
};

/// Writes the fractions of the change's voxels from `fractions`, even if they rise. Refused changes leave the
/// bone unchanged.
[[nodiscard]] Correction correct(const BrickChange& change, BrickFractions fractions, Bone& bone);

/// Changed voxels of a bone, brick by brick: a later change of a brick joins the earlier one. Whether voxels
/// rose or fell is forgotten.
class GatheredChanges {
  public:
    /// The gathered voxels of a brick, to add to.
    VoxelMask& voxels(BrickIndex brick) { return voxels_[brick]; }
    void add(const BrickChange& change) { voxels(change.brick) |= change.voxels; }
    void add(std::span<const BrickChange> changes) {
        for (const BrickChange& change : changes) add(change);
    }
    bool empty() const { return voxels_.empty(); }
    void clear() { voxels_.clear(); }

    /// Takes out the first bricks, at most so many, ascending.
    std::vector<BrickChange> take(std::size_t most_bricks = std::numeric_limits<std::size_t>::max()) {
        std::vector<BrickChange> taken;
        while (!voxels_.empty() && taken.size() < most_bricks) {
            taken.push_back({voxels_.begin()->first, voxels_.begin()->second});
            voxels_.erase(voxels_.begin());
        }
        return taken;
    }

  private:
    std::map<BrickIndex, VoxelMask> voxels_;
};

}  // namespace osteomill
