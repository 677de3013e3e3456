// Watch over the distances from the burr to the protected structures of a session, state by state. It keeps
// account of every touch: how often, how long, how much.
//
// The distance is that from the burr's head to the structure, from a distance field of the structure's own
// (burr_clearance.h): within half a voxel for a ball. A touch is a state in which they overlap, or bone of
// the structure was milled since the state before. State i stands for the time since state i - 1. The head
// has entered those voxels of the structure whose centre lay inside it at a state. Bone of the structure is
// all bone in its mask or with its tissue's label, such as the voxels of its surface that are bone by less
// than half.
//
// It takes a distance field for each structure, and a mask of the entered voxels once the structure is
// touched. Not for the haptic loop: it allocates.
#pragma once

#include <optional>
#include <vector>

#include "common/bone/brick_change.h"
#include "common/bone/structure_mask.h"
#include "common/scene/burr_clearance.h"
#include "common/scene/burr_profile.h"
#include "common/session/structure_distance.h"
#include "common/session/tool_state.h"

namespace osteomill {

/// Account of a structure in a session.
struct StructureAccount {
    StructureDistance last;              ///< as of the last state
    std::optional<double> nearest_mm{};  ///< smallest distance of all states; nothing: never within reach
    double given_back_mm3 = 0.0;         ///< bone of it that was milled and given back
};

class StructureWatch {
  public:
    /// A watch over nothing.
    StructureWatch() = default;
    /// `structures`: of one bone, by the index of their tissue. Throws std::length_error, in one line, for
    /// one whose distance field would be too large.
    StructureWatch(std::vector<Structure> structures, const std::vector<Tissue>& tissues,
                   const std::vector<Burr>& burrs);

    bool empty() const { return watched_.empty(); }
    /// A change of the bone, before it is applied: from the fractions `before` to `after`, of a brick whose
    /// voxels bear `labels` (nullptr: none).
    void note(const BrickChange& change, BrickFractions before, BrickFractions after,
              const ByteBrick* labels);
    /// The next state of the session, after note() of all changes before it. A state of time 0 does not
    /// count: it is the scene's start, before the device has been read.
    void update(const ToolState& tool);

    /// Distances of the structures that are near or were touched, as of the last state.
    const std::vector<StructureDistance>& distances() const { return distances_; }
    /// Accounts of all structures.
    std::vector<StructureAccount> accounts() const;
    /// Size of the masks and the distance fields.
    std::size_t memory_bytes() const;

  private:
    struct Watched {
        StructureMask mask;
        std::uint8_t label;
        DistanceField field;
        double watched_mm;
        StructureAccount account{};
        double last_touch_s;
        // In levels of fraction, 255 a voxel, so that nothing is lost to rounding.
        std::int64_t milled_levels = 0;
        std::int64_t restored_levels = 0;
        bool was_milled = false;           // since the last state
        std::vector<VoxelMask> entered{};  // of each brick of the mask; empty: nothing yet
        std::uint64_t entered_voxels = 0;
    };
    struct Head {
        BurrClearance clearance;
        std::optional<BurrProfile> profile;  // nothing: a ball
        double radius_mm;
        double reach_mm;  // of a ball about the burr's centre that holds all of it
    };

    void update(Watched& one, const ToolState& tool, double dt_s) const;
    static void enter(Watched& one, const Head& head, const ToolPose& pose);

    std::vector<Watched> watched_;
    std::vector<Head> heads_;  // of the burrs
    std::optional<double> last_s_;
    std::vector<StructureDistance> distances_;
};

}  // namespace osteomill
