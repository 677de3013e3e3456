// Where a burr must have come to rest to leave the bone as it is.
//
// What is left of a voxel ahead of the burr says how far its centre is from the burr's: the law of
// swept_guess.h, read backwards. With r = left / 255 - 1/2 and e = 1/2 - b/2, in voxels,
//
//     d = R + sign(r) |r|                                              where |r| <= e
//     d = R + sign(r) (e + b - sqrt(b^2 - 2 b (|r| - e)))              beyond
//
// The end of the way is the point whose distances from such voxels are closest to these (Gauss-Newton), each
// weighed by the square of the law's slope there: a fraction is rounded to a step, which near the flat ends
// of a smoothed ramp is worth ten times the distance that it is in its middle. The pose that clients are
// shown would do worse: it is up to a step older or newer than the edits, and a tenth of a voxel changes
// every fraction.
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

/// All in voxels: the burr went from `from` to about `estimate`; `smoothing` is b, 0 to 1. The estimate
/// itself where the voxels do not tell better: too few of them, or none of a ball near it.
glm::dvec3 fit_end_of_sweep(const glm::dvec3& from, const glm::dvec3& estimate, double radius,
                            double smoothing, const std::vector<PartVoxel>& voxels);

}  // namespace osteomill
