#include "simulation/cutting_force/head_force.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/cutting_force/axis_singularity_kernel.h"

namespace osteomill {

namespace {

/// Position of a removed voxel, burr axes, voxels.
glm::dvec3 position_of(const CuttingStep& step, const RemovedVoxels& removed, std::size_t i) {
    const glm::dvec3 voxel = glm::dvec3(removed.base) + glm::dvec3(removed.x[i], removed.y[i], removed.z[i]);
    return glm::transpose(step.frame) * (voxel - step.middle_voxels);
}

/// Advance of the surface toward a voxel, as a share of the path; edge_advance() is the same for a ball. The
/// voxel's distance from the surface is a parabola through its values at the path's start, half-way and at
/// its end. If the surface comes nearer all the way, the advance is how far; else it is half of how far it
/// would come at its first slope. A face within half a degree of the path counts as half a degree off: voxels
/// resolve no less.
double advance_share(const CuttingStep& step, const glm::dvec3& position, double half_way) {
    constexpr double least = 0.01;
    const glm::dvec3 half_path = static_cast<double>(step.half_path_voxels) * glm::dvec3(step.path_direction);
    const auto distance_at = [&](const glm::dvec3& p) {
        return step.head->nearest(std::hypot(p.x, p.y), p.z).distance;
    };
    const double start = distance_at(position + half_path);
    const double end = distance_at(position - half_path);
    const double advance = std::max(start - end, 1.5 * start - 2.0 * half_way + 0.5 * end);
    return std::max(0.5 * advance / static_cast<double>(step.half_path_voxels), least);
}

/// Its force, burr axes, in units of CuttingStep::newton_per_unit.
glm::dvec3 force_of(const CuttingStep& step, const glm::dvec3& position, double removed) {
    const double r_squared = position.x * position.x + position.y * position.y;
    const double r = std::sqrt(r_squared);
    const NearestSurface surface = step.head->nearest(r, position.z);
    const double per_r = 1.0 / std::max(r, 0.1);
    const AxisKernel<double> mean = axis_kernel(r_squared, per_r);

    const double weight =
        step.is_of_edges ? removed / advance_share(step, position, surface.distance) : removed;
    const glm::dvec3 k = weight * glm::dvec3(step.coefficients);
    // e_psi / r and e_r / r are the mean swirl times (-y, x) and (x, y).
    const double outward = (k.y * surface.out - k.z * surface.up) * mean.swirl;
    const double around = k.x * mean.swirl;
    return {around * position.y - outward * position.x, -around * position.x - outward * position.y,
            -(k.y * surface.up + k.z * surface.out) * mean.inverse};
}

}  // namespace

void head_forces(const CuttingStep& step, const RemovedVoxels& removed, std::span<const float> weights,
                 ChipForces& out) noexcept {
    for (std::size_t i = 0; i < removed.padded_count(); ++i) {
        const glm::dvec3 position = position_of(step, removed, i);
        const glm::dvec3 force = force_of(step, position, static_cast<double>(weights[i]));
        out.x[i] = static_cast<float>(position.x);
        out.y[i] = static_cast<float>(position.y);
        out.z[i] = static_cast<float>(position.z);
        out.force_x[i] = static_cast<float>(force.x);
        out.force_y[i] = static_cast<float>(force.y);
        out.force_z[i] = static_cast<float>(force.z);
    }
}

glm::dvec3 sum_of_head_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights) noexcept {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < removed.count; ++i)
        sum += force_of(step, position_of(step, removed, i), static_cast<double>(weights[i]));
    return sum;
}

}  // namespace osteomill
