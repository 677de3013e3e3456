#include "haptic_server/milling/chip_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptic_server/milling/burr_frame.h"

namespace osteomill {

namespace {

/// Inputs of the loop as plain floats: nothing in it may alias.
struct Constants {
    float xx, xy, xz, yx, yy, yz, zx, zy, zz;  // rows of the rotation into burr axes
    float middle_x, middle_y, middle_z;        // counted from the batch's base
    float per_radius;
    float tangential, radial, axial;
    float disc_radius;  // of what a point stands for, voxels
};

Constants constants(const CuttingStep& step, const glm::ivec3& base) {
    const glm::vec3 x(step.frame[0]);
    const glm::vec3 y(step.frame[1]);
    const glm::vec3 z(step.frame[2]);
    const glm::vec3 middle(step.middle_voxels - glm::dvec3(base));
    return {x.x,
            x.y,
            x.z,
            y.x,
            y.y,
            y.z,
            z.x,
            z.y,
            z.z,
            middle.x,
            middle.y,
            middle.z,
            static_cast<float>(1.0 / step.radius_voxels),
            step.coefficients.x,
            step.coefficients.y,
            step.coefficients.z,
            static_cast<float>(disc_radius_voxels)};
}

[[gnu::always_inline]] inline void loop_over(const Constants& in, std::size_t count, const float* vx,
                                             const float* vy, const float* vz, const float* weights,
                                             ChipForces& out) {
    const Constants c = in;
    const float disc_squared = c.disc_radius * c.disc_radius;
    for (std::size_t i = 0; i < count; ++i) {
        const float wx = vx[i] - c.middle_x;
        const float wy = vy[i] - c.middle_y;
        const float wz = vz[i] - c.middle_z;
        const float x = c.xx * wx + c.xy * wy + c.xz * wz;
        const float y = c.yx * wx + c.yy * wy + c.yz * wz;
        const float z = c.zx * wx + c.zy * wy + c.zz * wz;
        const float r_squared = x * x + y * y;
        const float distance_squared = r_squared + z * z;
        // No voxel of a crescent is that near the centre; padding may be.
        const float distance = std::sqrt(distance_squared < 0.25f ? 0.25f : distance_squared);
        const float disc_r = std::sqrt(r_squared < disc_squared ? disc_squared : r_squared);
        const float per_both = 1.0f / (distance * disc_r);  // one division for two
        const float per_disc_r = per_both * distance;
        const float cos_kappa = -z * (per_both * disc_r);
        const float to_surface = distance * c.per_radius;  // 1 / r there = this / r here
        const float mean_per_r = mean_inverse_distance(r_squared, per_disc_r, c.disc_radius);

        const float weight = weights[i];
        const float swirl = weight * to_surface * per_disc_r * per_disc_r;  // e / r, where e = (x, y) / r
        const float outward = c.axial * cos_kappa * swirl + c.radial * c.per_radius * weight * per_disc_r;
        out.x[i] = x;
        out.y[i] = y;
        out.z[i] = z;
        out.force_x[i] = c.tangential * swirl * y - outward * x;
        out.force_y[i] = -c.tangential * swirl * x - outward * y;
        out.force_z[i] = weight * (c.radial * cos_kappa * to_surface * mean_per_r - c.axial * c.per_radius);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void loop_over_avx2(const Constants& c, std::size_t count, const float* x,
                                            const float* y, const float* z, const float* weights,
                                            ChipForces& out) {
    loop_over(c, count, x, y, z, weights, out);
}
#endif

void forces_of(const Constants& c, std::size_t count, const float* x, const float* y, const float* z,
               const float* weights, [[maybe_unused]] InstructionSet instructions, ChipForces& out) {
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) {
        loop_over_avx2(c, count, x, y, z, weights, out);
        return;
    }
#endif
    loop_over(c, count, x, y, z, weights, out);
}

/// Voxels whose middle lies nearer to the axis than 1.4 voxels are taken apart.
constexpr float refined_r_squared = 2.0f;

float smallest_r_squared(const ChipForces& forces, std::size_t padded_count) {
    constexpr std::size_t lanes = RemovedVoxels::lanes;
    std::array<float, lanes> smallest;
    smallest.fill(refined_r_squared);
    for (std::size_t first = 0; first < padded_count; first += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float x = forces.x[first + lane];
            const float y = forces.y[first + lane];
            const float r_squared = x * x + y * y;
            smallest[lane] = r_squared < smallest[lane] ? r_squared : smallest[lane];
        }
    return *std::min_element(smallest.begin(), smallest.end());
}

/// Middles of the parts of a voxel taken apart into 4^3, along one axis: `run` parts in a row share a place.
constexpr std::size_t part_count = 64;
constexpr std::array<float, part_count> part_places(std::size_t run) {
    std::array<float, part_count> places{};
    for (std::size_t i = 0; i < part_count; ++i) places[i] = 0.25f * static_cast<float>(i / run % 4) - 0.375f;
    return places;
}

/// Force of such a voxel. `scratch` is overwritten.
glm::vec3 force_of_parts(const Constants& c, const glm::vec3& voxel, float weight,
                         InstructionSet instructions, ChipForces& scratch) {
    static constexpr auto part_x = part_places(1);
    static constexpr auto part_y = part_places(4);
    static constexpr auto part_z = part_places(16);
    Constants fine = c;
    fine.disc_radius = 0.25f * c.disc_radius;
    std::array<float, part_count> x;
    std::array<float, part_count> y;
    std::array<float, part_count> z;
    std::array<float, part_count> weights;
    for (std::size_t i = 0; i < part_count; ++i) {
        x[i] = voxel.x + part_x[i];
        y[i] = voxel.y + part_y[i];
        z[i] = voxel.z + part_z[i];
        weights[i] = weight / part_count;
    }
    forces_of(fine, part_count, x.data(), y.data(), z.data(), weights.data(), instructions, scratch);
    return glm::vec3(sum_of(scratch, part_count));
}

}  // namespace

CuttingStep::CuttingStep(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& middle,
                         double spacing, double elapsed)
    : frame(burr_frame(spindle_axis)),
      middle_voxels(middle),
      radius_voxels(burr.radius_mm() / spacing),
      spacing_mm(spacing),
      coefficients(glm::dvec3(burr.sigma(), 1.0, 1.0) * burr.cutting_coefficients_n_per_mm2),
      elapsed_s(elapsed),
      // V / r in units of the spacing: h^3 / (r h) = h^2 / r.
      newton_per_unit(spacing * spacing / (2.0 * std::numbers::pi * burr.spindle_rev_per_s * elapsed)) {}

void chip_forces(const CuttingStep& step, const RemovedVoxels& removed, std::span<const float> weights,
                 InstructionSet instructions, ChipForces& out) noexcept {
    const Constants c = constants(step, removed.base);
    const std::size_t count = removed.padded_count();
    forces_of(c, count, removed.x.data(), removed.y.data(), removed.z.data(), weights.data(), instructions,
              out);
    if (smallest_r_squared(out, count) >= refined_r_squared) return;
    ChipForces parts;
    for (std::size_t i = 0; i < removed.count; ++i) {
        if (out.x[i] * out.x[i] + out.y[i] * out.y[i] >= refined_r_squared) continue;
        const glm::vec3 voxel(removed.x[i], removed.y[i], removed.z[i]);
        const glm::vec3 force = force_of_parts(c, voxel, weights[i], instructions, parts);
        out.force_x[i] = force.x;
        out.force_y[i] = force.y;
        out.force_z[i] = force.z;
    }
}

glm::dvec3 sum_of(const ChipForces& forces, std::size_t padded_count) noexcept {
    constexpr std::size_t lanes = RemovedVoxels::lanes;
    std::array<float, lanes> x{};
    std::array<float, lanes> y{};
    std::array<float, lanes> z{};
    for (std::size_t first = 0; first < padded_count; first += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            x[lane] += forces.force_x[first + lane];
            y[lane] += forces.force_y[first + lane];
            z[lane] += forces.force_z[first + lane];
        }
    glm::dvec3 sum(0.0);
    for (std::size_t lane = 0; lane < lanes; ++lane) sum += glm::dvec3(x[lane], y[lane], z[lane]);
    return sum;
}

}  // namespace osteomill
