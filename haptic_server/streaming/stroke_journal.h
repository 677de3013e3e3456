// Journal of the bone removed by each slice of a stroke, which is what one undo gives back, for any number of
// undos and redos. Its functions call a slice a stroke.
//
// The owner, ControlRunner, ends one where UndoSlice does (common/session/stroke_span.h). For each changed
// brick the journal keeps the mask of its voxels and, compressed, their fractions before: no second copy of
// the bone. An undone stroke keeps the fractions after it instead, for redo.
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
    /// The bricks that restore any number of strokes: each once.
    using Restoration = std::map<BrickIndex, Restored>;
    /// Adds the changes that restore the bone of the last closed stroke, or remove it again. After everything
    /// already in `restoration`, `bone` is as that stroke left it, or found it. No stroke is open, and there
    /// is one to undo, or to redo. Returns how many levels of fraction come back; removed again: below zero.
    std::int64_t undo(const Bone& bone, Restoration& restoration);
    std::int64_t redo(const Bone& bone, Restoration& restoration);

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
    /// Moves the last of `from` to the end of `to`, with the bone's present fractions.
    std::int64_t move(std::vector<Stroke>& from, std::vector<Stroke>& to, const Bone& bone,
                      Restoration& restoration);

    std::map<BrickIndex, Restored> open_;
    ZstdCompressor compressor_{1};
    std::vector<Stroke> done_;
    std::vector<Stroke> undone_;
};

}  // namespace osteomill
