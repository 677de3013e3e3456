#include "haptic_server/streaming/sweep_fit.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace osteomill {

namespace {

/// It converges in two or three.
constexpr int rounds = 4;
/// Fewer say more of the rounding of their fractions than of the burr.
constexpr int fewest_voxels = 12;
/// A voxel farther off tells of another pass of the burr, or of the bone's surface.
constexpr double farthest_off_voxels = 1.0;
constexpr double longest_correction_voxels = 2.0;

}  // namespace

glm::dvec3 fit_end_of_sweep(const glm::dvec3& from, const glm::dvec3& estimate, double radius,
                            const std::vector<PartVoxel>& voxels) {
    glm::dvec3 end = estimate;
    for (int round = 0; round < rounds; ++round) {
        // A little of the identity: what lies in one direction alone says nothing across it.
        glm::dmat3 normal(1e-3);
        glm::dvec3 gradient(0.0);
        int used = 0;
        for (const PartVoxel& voxel : voxels) {
            const glm::dvec3 off = voxel.position - end;
            if (glm::dot(off, end - from) < 0.0) continue;  // nearer to the way than to its end
            const double distance = glm::length(off);
            const double missing = distance - (radius - 0.5 + voxel.left / 255.0);
            if (distance <= 0.0 || std::abs(missing) > farthest_off_voxels) continue;
            const glm::dvec3 direction = off / distance;
            normal += glm::outerProduct(direction, direction);
            gradient += missing * direction;
            ++used;
        }
        if (used < fewest_voxels) return estimate;
        end += glm::inverse(normal) * gradient;
    }
    return glm::distance(end, estimate) <= longest_correction_voxels ? end : estimate;
}

}  // namespace osteomill
