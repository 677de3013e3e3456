// Interface of the older contact laws: the force of bone on a burr that overlaps it, and a rate of erosion.
// eroding_model.h turns a law into a contact model.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <memory>

#include "common/bone/bone.h"
#include "common/scene/burr.h"
#include "simulation/engagement/brick_neighbourhood.h"

namespace osteomill {

/// A burr near bone. Lengths in voxels where they say so.
struct BurrContact {
    const Bone& bone;
    const BrickNeighbourhood& bricks;  ///< gathered: at least one brick near the burr is stored
    const Burr& burr;
    glm::dvec3 centre_voxels;  ///< of the burr, voxel coordinates
    double radius_voxels;      ///< of the burr
    glm::dvec3 spindle_axis;   ///< unit, patient axes
    bool spindle_on;

    /// Laws may look at positions in `bricks` up to this far beyond the burr's surface.
    static constexpr double margin_voxels = 3.0;

    double spacing_mm() const { return bone.grid().spacing_mm; }
    /// A position in the coordinates of `bricks`.
    glm::vec3 in_bricks(const glm::dvec3& voxel_coordinates) const {
        return glm::vec3(voxel_coordinates - glm::dvec3(bricks.base()));
    }
};

struct ContactReaction {
    glm::dvec3 force_n{0.0};     ///< of the bone on the burr, patient axes
    double erosion_per_s = 0.0;  ///< erosion.h; counts only while the spindle is on
};

/// Trust in the direction of a sum of vectors, of total length `total`, 0 to 1. As bone swallows the burr the
/// vectors nearly cancel; below a fiftieth of the total their sum points wherever the lattice is uneven, so
/// the force fades out with it. The burr is then all but a fiftieth within bone.
inline double trust_in_direction(double resultant, double total) {
    constexpr double least_trusted_share = 0.02;
    return total > 0.0 ? std::min(1.0, resultant / (least_trusted_share * total)) : 0.0;
}

class ContactLaw {
  public:
    virtual ~ContactLaw() = default;

    /// Real-time safe; one thread at a time.
    virtual ContactReaction react(const BurrContact& contact) noexcept = 0;

    /// A copy that goes on from here alike.
    virtual std::unique_ptr<ContactLaw> copy() const = 0;
};

}  // namespace osteomill
