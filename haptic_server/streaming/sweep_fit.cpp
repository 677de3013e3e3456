#include "haptic_server/streaming/sweep_fit.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace osteomill {

namespace {

/// It converges in two or three.
constexpr int rounds = 4;
/// Fewer say more of the rounding of their fractions than of the burr. In the middle of the ramp: those at
/// its ends count for less.
constexpr double fewest_voxels = 12.0;
/// A voxel farther off tells of another pass of the burr, or of the bone's surface.
constexpr double farthest_off_voxels = 1.0;
constexpr double longest_correction_voxels = 2.0;

/// What a voxel says by what is left of it.
struct Reading {
    double beyond = 0.0;  ///< how far its centre is outside of the ball, voxels
    double weight = 0.0;  ///< 1 where a step of the fraction is a step of the distance
};

Reading reading_of(double left, double smoothing) {
    const double rise = left / 255.0 - 0.5;
    const double bend = 0.5 - 0.5 * smoothing;
    const double past = std::abs(rise) - bend;
    if (past <= 0.0) return {rise, 1.0};
    const double to_end = std::sqrt(smoothing * smoothing - 2.0 * smoothing * past);
    const double slope = to_end / smoothing;
    return {std::copysign(bend + smoothing - to_end, rise), slope * slope};
}

/// By what is left, 1 to 254.
std::array<Reading, 255> readings(double smoothing) {
    std::array<Reading, 255> all;
    for (std::size_t left = 1; left < all.size(); ++left)
        all[left] = reading_of(static_cast<double>(left), smoothing);
    return all;
}

}  // namespace

glm::dvec3 fit_end_of_sweep(const glm::dvec3& from, const glm::dvec3& estimate, double radius,
                            double smoothing, const std::vector<PartVoxel>& voxels) {
    const std::array<Reading, 255> by_left = readings(smoothing);
    glm::dvec3 end = estimate;
    for (int round = 0; round < rounds; ++round) {
        // A little of the identity: what lies in one direction alone says nothing across it.
        glm::dmat3 normal(1e-3);
        glm::dvec3 gradient(0.0);
        double used = 0.0;
        for (const PartVoxel& voxel : voxels) {
            const glm::dvec3 off = voxel.position - end;
            if (glm::dot(off, end - from) < 0.0) continue;  // nearer to the way than to its end
            const double distance = glm::length(off);
            const Reading& reading = by_left[voxel.left];
            const double missing = distance - (radius + reading.beyond);
            if (distance <= 0.0 || std::abs(missing) > farthest_off_voxels) continue;
            const glm::dvec3 direction = off / distance;
            normal += reading.weight * glm::outerProduct(direction, direction);
            gradient += reading.weight * missing * direction;
            used += reading.weight;
        }
        if (used < fewest_voxels) return estimate;
        end += glm::inverse(normal) * gradient;
    }
    return glm::distance(end, estimate) <= longest_correction_voxels ? end : estimate;
}

}  // namespace osteomill
