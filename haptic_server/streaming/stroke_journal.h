// Journal of the bone that each stroke took, so that strokes can be undone and redone, any number of them.
//
// Where a stroke ends is its owner's business (common/scene/stroke_span.h). For each brick that it changed
// the journal keeps the mask of its voxels and, compressed, what was left of them before: no second copy of
// the bone. Undone, a stroke keeps what was left after it instead, to be redone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/wire/zstd_compressor.h"

namespace osteomill {

class StrokeJournal {
  public:
    /// Before `change` is applied to `bone`. Opens a stroke, if none is open; strokes that were undone are
    /// then gone for good. One that restores is no stroke's.
    void note(const BrickChange& change, const Bone& bone);
    /// Closes the open stroke, if there is one.
    void end_stroke();
    bool has_open_stroke() const { return !open_.empty(); }

    std::size_t undo_steps() const { return done_.size(); }
    std::size_t redo_steps() const { return undone_.size(); }

    /// A change that restores, and the fractions of its voxels (those of the mask; the others are 0).
    struct Restored {
        BrickChange change;
        ByteBrick fractions;
    };
    /// What restores any number of strokes: each brick once.
    using Restoration = std::map<BrickIndex, Restored>;
    /// Adds what gives the bone back that the last closed stroke took, or takes it again. `bone`, once all
    /// that is in `restoration` already is done, is as that stroke left it, or found it. No stroke is open,
    /// and there is one to undo, to redo.
    void undo(const Bone& bone, Restoration& restoration);
    void redo(const Bone& bone, Restoration& restoration);

    /// Bytes that the closed strokes take.
    std::size_t memory_bytes() const;

  private:
    /// Compressed, brick by brick.
    struct Stroke {
        std::size_t bricks = 0;
        std::vector<std::uint8_t> packed;
    };

    Stroke pack(const std::vector<Restored>& bricks);
    static std::vector<Restored> unpack(const Stroke& stroke);
    /// Takes the last of `from`, which then is at the end of `to` with what the bone has now.
    void move(std::vector<Stroke>& from, std::vector<Stroke>& to, const Bone& bone, Restoration& restoration);

    std::map<BrickIndex, Restored> open_;
    ZstdCompressor compressor_{1};
    std::vector<Stroke> done_;
    std::vector<Stroke> undone_;
};

}  // namespace osteomill
