#include "haptic_server/milling/chip_force.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "haptic_server/milling/burr_frame.h"
#include "haptic_server/milling/lanes.h"

namespace osteomill {

namespace {

using lanes::Floats;

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

/// Eight voxels in burr axes and their forces.
struct EightForces {
    Floats x, y, z;
    Floats force_x, force_y, force_z;
    Floats r_squared;
};

[[gnu::always_inline]] inline EightForces forces_of(const Constants& c, const Floats& vx, const Floats& vy,
                                                    const Floats& vz, const Floats& weight) {
    const Floats wx = vx - c.middle_x;
    const Floats wy = vy - c.middle_y;
    const Floats wz = vz - c.middle_z;
    const Floats x = c.xx * wx + c.xy * wy + c.xz * wz;
    const Floats y = c.yx * wx + c.yy * wy + c.yz * wz;
    const Floats z = c.zx * wx + c.zy * wy + c.zz * wz;
    const Floats r_squared = x * x + y * y;
    const Floats distance_squared = r_squared + z * z;
    const Floats disc_squared = lanes::floats(c.disc_radius * c.disc_radius);
    // No voxel of a crescent is that near the centre; padding may be.
    const Floats distance =
        lanes::square_root(distance_squared < 0.25f ? lanes::floats(0.25f) : distance_squared);
    const Floats disc_r = lanes::square_root(r_squared < disc_squared ? disc_squared : r_squared);
    const Floats per_both = 1.0f / (distance * disc_r);  // one division for two
    const Floats per_disc_r = per_both * distance;
    const Floats cos_kappa = -z * (per_both * disc_r);
    const Floats to_surface = distance * c.per_radius;  // 1 / r there = this / r here
    const Floats mean_per_r = mean_inverse_distance(r_squared, per_disc_r, lanes::floats(c.disc_radius));

    const Floats swirl = weight * to_surface * per_disc_r * per_disc_r;  // e / r, where e = (x, y) / r
    const Floats outward = c.axial * cos_kappa * swirl + c.radial * c.per_radius * weight * per_disc_r;
    return {x,
            y,
            z,
            c.tangential * swirl * y - outward * x,
            -c.tangential * swirl * x - outward * y,
            weight * (c.radial * cos_kappa * to_surface * mean_per_r - c.axial * c.per_radius),
            r_squared};
}

/// Voxels whose middle lies nearer to the axis than 1.4 voxels are taken apart.
constexpr float refined_r_squared = 2.0f;

/// Fills in the voxels of `out`; returns the smallest r^2 among them.
[[gnu::always_inline]] inline float fill_with(const Constants& constants, std::size_t count, const float* vx,
                                              const float* vy, const float* vz, const float* weights,
                                              ChipForces& out) {
    const Constants c = constants;
    Floats nearest = lanes::floats(refined_r_squared);
    for (std::size_t i = 0; i < count; i += lanes::width) {
        const EightForces f = forces_of(c, lanes::load<Floats>(vx + i), lanes::load<Floats>(vy + i),
                                        lanes::load<Floats>(vz + i), lanes::load<Floats>(weights + i));
        lanes::store(&out.x[i], f.x);
        lanes::store(&out.y[i], f.y);
        lanes::store(&out.z[i], f.z);
        lanes::store(&out.force_x[i], f.force_x);
        lanes::store(&out.force_y[i], f.force_y);
        lanes::store(&out.force_z[i], f.force_z);
        nearest = f.r_squared < nearest ? f.r_squared : nearest;
    }
    return lanes::smallest(nearest);
}

struct Sum {
    glm::dvec3 force{0.0};
    std::uint64_t left_out = 0;  // bit i: some of eight voxels from 8 i on
};
static_assert(RemovedVoxels::capacity / RemovedVoxels::lanes <= 64);

/// Sum over those voxels that need not be taken apart.
[[gnu::always_inline]] inline Sum sum_with(const Constants& constants, std::size_t count, const float* vx,
                                           const float* vy, const float* vz, const float* weights,
                                           float least_r_squared) {
    const Constants c = constants;
    const Floats zero{};
    Floats x{};
    Floats y{};
    Floats z{};
    std::uint64_t left_out = 0;
    for (std::size_t i = 0; i < count; i += lanes::width) {
        const EightForces f = forces_of(c, lanes::load<Floats>(vx + i), lanes::load<Floats>(vy + i),
                                        lanes::load<Floats>(vz + i), lanes::load<Floats>(weights + i));
        left_out |= std::uint64_t{lanes::any(f.r_squared < least_r_squared)} << (i / lanes::width);
        x += f.r_squared < least_r_squared ? zero : f.force_x;
        y += f.r_squared < least_r_squared ? zero : f.force_y;
        z += f.r_squared < least_r_squared ? zero : f.force_z;
    }
    return {{lanes::sum(x), lanes::sum(y), lanes::sum(z)}, left_out};
}

float fill_plain(const Constants& c, std::size_t count, const float* x, const float* y, const float* z,
                 const float* weights, ChipForces& out) {
    return fill_with(c, count, x, y, z, weights, out);
}

Sum sum_plain(const Constants& c, std::size_t count, const float* x, const float* y, const float* z,
              const float* weights, float least_r_squared) {
    return sum_with(c, count, x, y, z, weights, least_r_squared);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] float fill_avx2(const Constants& c, std::size_t count, const float* x, const float* y,
                                        const float* z, const float* weights, ChipForces& out) {
    return fill_with(c, count, x, y, z, weights, out);
}

[[gnu::target("avx2")]] Sum sum_avx2(const Constants& c, std::size_t count, const float* x, const float* y,
                                     const float* z, const float* weights, float least_r_squared) {
    return sum_with(c, count, x, y, z, weights, least_r_squared);
}
#endif

float fill(const Constants& c, std::size_t count, const float* x, const float* y, const float* z,
           const float* weights, [[maybe_unused]] InstructionSet instructions, ChipForces& out) {
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return fill_avx2(c, count, x, y, z, weights, out);
#endif
    return fill_plain(c, count, x, y, z, weights, out);
}

Sum sum(const Constants& c, std::size_t count, const float* x, const float* y, const float* z,
        const float* weights, float least_r_squared, [[maybe_unused]] InstructionSet instructions) {
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return sum_avx2(c, count, x, y, z, weights, least_r_squared);
#endif
    return sum_plain(c, count, x, y, z, weights, least_r_squared);
}

/// Middles of the parts of a voxel taken apart into 4^3, along one axis: `run` parts in a row share a place.
constexpr std::size_t part_count = 64;
constexpr std::array<float, part_count> part_places(std::size_t run) {
    std::array<float, part_count> places{};
    for (std::size_t i = 0; i < part_count; ++i) places[i] = 0.25f * static_cast<float>(i / run % 4) - 0.375f;
    return places;
}

/// Force of such a voxel.
glm::dvec3 force_of_parts(const Constants& c, const glm::vec3& voxel, float weight,
                          InstructionSet instructions) {
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
    return sum(fine, part_count, x.data(), y.data(), z.data(), weights.data(), 0.0f, instructions).force;
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
    const float smallest_r_squared = fill(c, count, removed.x.data(), removed.y.data(), removed.z.data(),
                                          weights.data(), instructions, out);
    if (smallest_r_squared >= refined_r_squared) return;
    for (std::size_t i = 0; i < removed.count; ++i) {
        if (out.x[i] * out.x[i] + out.y[i] * out.y[i] >= refined_r_squared) continue;
        const glm::vec3 voxel(removed.x[i], removed.y[i], removed.z[i]);
        const glm::vec3 force(force_of_parts(c, voxel, weights[i], instructions));
        out.force_x[i] = force.x;
        out.force_y[i] = force.y;
        out.force_z[i] = force.z;
    }
}

glm::dvec3 sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights, InstructionSet instructions) noexcept {
    const Constants c = constants(step, removed.base);
    Sum total = sum(c, removed.padded_count(), removed.x.data(), removed.y.data(), removed.z.data(),
                    weights.data(), refined_r_squared, instructions);
    for (std::size_t i = 0; i < removed.count; ++i) {
        if ((total.left_out >> (i / RemovedVoxels::lanes) & 1u) == 0) {
            i += RemovedVoxels::lanes - 1;
            continue;
        }
        const glm::vec3 voxel(removed.x[i], removed.y[i], removed.z[i]);
        const glm::vec3 w = voxel - glm::vec3(c.middle_x, c.middle_y, c.middle_z);
        const float x = c.xx * w.x + c.xy * w.y + c.xz * w.z;
        const float y = c.yx * w.x + c.yy * w.y + c.yz * w.z;
        if (weights[i] != 0.0f && x * x + y * y < refined_r_squared)
            total.force += force_of_parts(c, voxel, weights[i], instructions);
    }
    return total.force;
}

}  // namespace osteomill
