// Bone's surface in front of each of a burr's patches: the inner loop of an engagement map, eight patches
// at a time.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "simulation/carving/instruction_set.h"
#include "simulation/engagement/brick_neighbourhood.h"
#include "simulation/engagement/burr_patches.h"

namespace osteomill {

/// Assumption about the bone inside the burr.
enum class InsideBurr {
    any,    ///< nothing
    carved  ///< the burr has carved where it is, and there is nothing that it does not cut
};

/// Where bone begins before a patch, between two of the sampled positions along its normal. Offsets from the
/// patch outward, voxels.
struct PatchCrossing {
    std::int32_t patch = 0;
    float offset_voxels = 0.0f;
    float bone_offset_voxels = 0.0f;  ///< of the outer position
    float share = 1.0f;               ///< of the patch that has bone before it
};

/// Allocates when constructed.
class PatchCrossings {
  public:
    PatchCrossings(std::span<const BurrPatch> patches, double spacing_mm,
                   InstructionSet instructions = best_instruction_set());

    /// Crossings of the patches that have bone within Engagement::reach_voxels, in their order; valid until
    /// the next call. Bone begins where the trilinear fraction crosses half of what it is behind, the
    /// innermost time: at a rim bone fills a part of each voxel, and lies before so much of a patch. Farther
    /// than half a voxel ahead, where nothing tells what is behind, and before a burr that has not carved it
    /// begins at one half. `frame`: burr axes
    /// in patient axes; `centre_voxels` from the bricks' base. Real-time safe.
    std::span<const PatchCrossing> find(const BrickNeighbourhood& bricks, const glm::mat3& frame,
                                        const glm::vec3& centre_voxels, float radius_voxels,
                                        InsideBurr inside) noexcept;

  private:
    /// The inner loops; in the source, where vectors are at home.
    struct Loops;
    struct Look;
    std::size_t find_plain(const Look& look) noexcept;
    std::size_t find_avx2(const Look& look) noexcept;

    std::size_t count_;
    bool has_beside_ = false;  // of a head that is no ball
    InstructionSet instructions_;
    // By axis, filled up to whole eights with the last patch.
    std::array<std::vector<float>, 3> normals_;
    std::array<std::vector<float>, 3> beside_voxels_;
    std::vector<PatchCrossing> found_;  // scratch
};

}  // namespace osteomill
