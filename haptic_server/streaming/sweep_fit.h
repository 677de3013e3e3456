// Where a burr must have come to rest to leave the bone as it is.
//
// What is left of a voxel ahead of the burr says how far its centre is from the burr's (see cover.h of
// milling): d = R - 1/2 + left / 255 in voxels. The end of the way is the point whose distances from such
// voxels are closest to these (Gauss-Newton). The pose that clients are shown would do worse: it is up to a
// step older or newer than the edits, and a tenth of a voxel changes every fraction.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

/// A voxel that is partly gone.
struct PartVoxel {
    glm::dvec3 position{0.0};  ///< of its centre, in voxels
    std::uint8_t left = 0;     ///< 1 to 254
};

/// All in voxels: the burr went from `from` to about `estimate`. The estimate itself where the voxels do not
/// tell better: too few of them, or none of a ball near it.
glm::dvec3 fit_end_of_sweep(const glm::dvec3& from, const glm::dvec3& estimate, double radius,
                            const std::vector<PartVoxel>& voxels);

}  // namespace osteomill
