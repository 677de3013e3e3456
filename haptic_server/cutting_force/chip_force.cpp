#include "haptic_server/cutting_force/chip_force.h"

#include <cmath>
#include <numbers>

#include "common/scene/burr_frame.h"
#include "haptic_server/carving/simd.h"
#include "haptic_server/cutting_force/axis_singularity_kernel.h"

namespace osteomill {

namespace {

using simd::Floats;

/// Inputs of the loop as plain floats: nothing in it may alias.
struct Constants {
    float xx, xy, xz, yx, yy, yz, zx, zy, zz;  // rows of the rotation into burr axes
    float middle_x, middle_y, middle_z;        // counted from the batch's base
    float tangential, radial, axial;
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
            step.coefficients.x,
            step.coefficients.y,
            step.coefficients.z};
}

/// Eight positions in burr axes.
struct EightPositions {
    Floats x, y, z;
};

/// Of the voxels at (*vx, *vy, *vz) and the seven that follow.
[[gnu::always_inline]] inline EightPositions positions_of(const Constants& c, const float* vx,
                                                          const float* vy, const float* vz) {
    const Floats wx = simd::load<Floats>(vx) - c.middle_x;
    const Floats wy = simd::load<Floats>(vy) - c.middle_y;
    const Floats wz = simd::load<Floats>(vz) - c.middle_z;
    return {c.xx * wx + c.xy * wy + c.xz * wz, c.yx * wx + c.yy * wy + c.yz * wz,
            c.zx * wx + c.zy * wy + c.zz * wz};
}

/// And their forces.
struct EightForces {
    Floats x, y, z;
    Floats force_x, force_y, force_z;
};

[[gnu::always_inline]] inline EightForces forces_of(const Constants& c, const EightPositions& positions,
                                                    const Floats& weight) {
    const Floats& x = positions.x;
    const Floats& y = positions.y;
    const Floats& z = positions.z;
    const Floats r_squared = x * x + y * y;
    const Floats distance_squared = r_squared + z * z;
    // No voxel of a crescent is that near the centre; padding may be.
    const Floats distance =
        simd::square_root(distance_squared < 0.25f ? simd::floats(0.25f) : distance_squared);
    const Floats r = simd::square_root(r_squared < 0.01f ? simd::floats(0.01f) : r_squared);
    const Floats per_both = 1.0f / (distance * r);  // one division for two
    const Floats per_distance = per_both * r;
    const Floats cos_kappa = -z * per_distance;
    const Floats per_r = per_both * distance;
    const bool any_near = simd::any(r_squared < axis_disc_voxels * axis_disc_voxels);  // few are
    const AxisKernel<Floats> mean = any_near ? axis_kernel(r_squared, per_r) : far_axis_kernel(per_r);

    const Floats swirl = weight * mean.swirl;
    const Floats outward = c.axial * cos_kappa * swirl + c.radial * per_distance * weight * mean.outward;
    return {x,
            y,
            z,
            c.tangential * swirl * y - outward * x,
            -c.tangential * swirl * x - outward * y,
            weight * (c.radial * cos_kappa * mean.inverse - c.axial * per_distance)};
}

[[gnu::always_inline]] inline void fill_with(const Constants& constants, std::size_t count, const float* vx,
                                             const float* vy, const float* vz, const float* weights,
                                             ChipForces& out) {
    const Constants c = constants;
    for (std::size_t i = 0; i < count; i += simd::width) {
        const EightForces f =
            forces_of(c, positions_of(c, vx + i, vy + i, vz + i), simd::load<Floats>(weights + i));
        simd::store(&out.x[i], f.x);
        simd::store(&out.y[i], f.y);
        simd::store(&out.z[i], f.z);
        simd::store(&out.force_x[i], f.force_x);
        simd::store(&out.force_y[i], f.force_y);
        simd::store(&out.force_z[i], f.force_z);
    }
}

[[gnu::always_inline]] inline glm::dvec3 sum_with(const Constants& constants, std::size_t count,
                                                  const float* vx, const float* vy, const float* vz,
                                                  const float* weights) {
    const Constants c = constants;
    Floats x{};
    Floats y{};
    Floats z{};
    for (std::size_t i = 0; i < count; i += simd::width) {
        const EightForces f =
            forces_of(c, positions_of(c, vx + i, vy + i, vz + i), simd::load<Floats>(weights + i));
        x += f.force_x;
        y += f.force_y;
        z += f.force_z;
    }
    return {simd::sum(x), simd::sum(y), simd::sum(z)};
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fill_avx2(const Constants& c, std::size_t count, const float* x, const float* y,
                                       const float* z, const float* weights, ChipForces& out) {
    fill_with(c, count, x, y, z, weights, out);
}

[[gnu::target("avx2")]] glm::dvec3 sum_avx2(const Constants& c, std::size_t count, const float* x,
                                            const float* y, const float* z, const float* weights) {
    return sum_with(c, count, x, y, z, weights);
}
#endif

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
                 [[maybe_unused]] InstructionSet instructions, ChipForces& out) noexcept {
    const Constants c = constants(step, removed.base);
    const std::size_t count = removed.padded_count();
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) {
        fill_avx2(c, count, removed.x.data(), removed.y.data(), removed.z.data(), weights.data(), out);
        return;
    }
#endif
    fill_with(c, count, removed.x.data(), removed.y.data(), removed.z.data(), weights.data(), out);
}

glm::dvec3 sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights,
                              [[maybe_unused]] InstructionSet instructions) noexcept {
    const Constants c = constants(step, removed.base);
    const std::size_t count = removed.padded_count();
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2)
        return sum_avx2(c, count, removed.x.data(), removed.y.data(), removed.z.data(), weights.data());
#endif
    return sum_with(c, count, removed.x.data(), removed.y.data(), removed.z.data(), weights.data());
}

}  // namespace osteomill
