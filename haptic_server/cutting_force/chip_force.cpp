#include "haptic_server/cutting_force/chip_force.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "common/scene/burr_frame.h"
#include "haptic_server/carving/simd.h"
#include "haptic_server/cutting_force/axis_singularity_kernel.h"
#include "haptic_server/cutting_force/edge_advance.h"
#include "haptic_server/cutting_force/head_force.h"

namespace osteomill {

namespace {

using simd::Floats;
using simd::Floats3;

/// Inputs of the loop: nothing in it may alias.
struct Constants {
    [[gnu::always_inline]] Constants(const CuttingStep& step, const glm::ivec3& base)
        : x_axis(simd::floats3(step.frame[0])),
          y_axis(simd::floats3(step.frame[1])),
          z_axis(simd::floats3(step.frame[2])),
          middle(simd::floats3(step.middle_voxels - glm::dvec3(base))),
          tangential(simd::floats(step.coefficients.x)),
          radial(simd::floats(step.coefficients.y)),
          axial(simd::floats(step.coefficients.z)),
          edge(simd::floats3(step.edge_coefficients_n_per_mm)),
          path_direction(simd::floats3(step.path_direction)),
          per_full_chip(simd::floats(step.per_full_chip_mm)),
          half_path(simd::floats(step.half_path_voxels)) {}

    Floats3 x_axis, y_axis, z_axis;  // of the burr
    Floats3 middle;                  // counted from the batch's base
    Floats tangential, radial, axial;
    Floats3 edge;            // tangential, radial, axial
    Floats3 path_direction;  // burr axes
    Floats per_full_chip;
    Floats half_path;
};

[[gnu::always_inline]] inline Floats dot(const Floats3& a, const Floats3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Positions in burr axes of the voxels at (*vx, *vy, *vz) and the seven that follow.
[[gnu::always_inline]] inline Floats3 positions_of(const Constants& c, const float* vx, const float* vy,
                                                   const float* vz) {
    const Floats3 from_middle{simd::load<Floats>(vx) - c.middle.x, simd::load<Floats>(vy) - c.middle.y,
                              simd::load<Floats>(vz) - c.middle.z};
    return {dot(c.x_axis, from_middle), dot(c.y_axis, from_middle), dot(c.z_axis, from_middle)};
}

/// Forces of the voxels there.
template <bool has_edge_force>
[[gnu::always_inline]] inline Floats3 forces_of(const Constants& c, const Floats3& position,
                                                const Floats& weight, const Floats& edge_weight) {
    const Floats& x = position.x;
    const Floats& y = position.y;
    const Floats& z = position.z;
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

    if constexpr (has_edge_force) {
        const Floats turn = simd::larger(c.half_path * per_distance, simd::floats(least_turn));
        const Floats ahead = dot(position, c.path_direction) * per_distance;
        const Floats per_chip = c.per_full_chip * edge_weight / edge_advance(ahead, turn);
        const Floats tangential = c.tangential * weight + c.edge.x * per_chip;
        const Floats radial = c.radial * weight + c.edge.y * per_chip;
        const Floats axial = c.axial * weight + c.edge.z * per_chip;
        const Floats outward = axial * cos_kappa * mean.swirl + radial * per_distance * mean.outward;
        return {tangential * mean.swirl * y - outward * x, -tangential * mean.swirl * x - outward * y,
                radial * cos_kappa * mean.inverse - axial * per_distance};
    }
    const Floats swirl = weight * mean.swirl;
    const Floats outward = c.axial * cos_kappa * swirl + c.radial * per_distance * weight * mean.outward;
    return {c.tangential * swirl * y - outward * x, -c.tangential * swirl * x - outward * y,
            weight * (c.radial * cos_kappa * mean.inverse - c.axial * per_distance)};
}

template <bool has_edge_force>
[[gnu::always_inline]] inline void fill_with(const CuttingStep& step, const RemovedVoxels& removed,
                                             const ChipWeights& weights, ChipForces& out) {
    const Constants c(step, removed.base);
    for (std::size_t i = 0; i < removed.padded_count(); i += simd::width) {
        const Floats3 position = positions_of(c, &removed.x[i], &removed.y[i], &removed.z[i]);
        const Floats3 force =
            forces_of<has_edge_force>(c, position, simd::load<Floats>(weights.chip.data() + i),
                                      simd::load<Floats>(weights.edge.data() + i));
        simd::store(&out.x[i], position.x);
        simd::store(&out.y[i], position.y);
        simd::store(&out.z[i], position.z);
        simd::store(&out.force_x[i], force.x);
        simd::store(&out.force_y[i], force.y);
        simd::store(&out.force_z[i], force.z);
    }
}

template <bool has_edge_force>
[[gnu::always_inline]] inline glm::dvec3 sum_with(const CuttingStep& step, const RemovedVoxels& removed,
                                                  const ChipWeights& weights) {
    const Constants c(step, removed.base);
    Floats3 sum{};
    for (std::size_t i = 0; i < removed.padded_count(); i += simd::width) {
        const Floats3 force = forces_of<has_edge_force>(
            c, positions_of(c, &removed.x[i], &removed.y[i], &removed.z[i]),
            simd::load<Floats>(weights.chip.data() + i), simd::load<Floats>(weights.edge.data() + i));
        sum.x += force.x;
        sum.y += force.y;
        sum.z += force.z;
    }
    return {simd::sum(sum.x), simd::sum(sum.y), simd::sum(sum.z)};
}

[[gnu::always_inline]] inline void fill_by_law(const CuttingStep& step, const RemovedVoxels& removed,
                                               const ChipWeights& weights, ChipForces& out) {
    step.has_edge_force ? fill_with<true>(step, removed, weights, out)
                        : fill_with<false>(step, removed, weights, out);
}

[[gnu::always_inline]] inline glm::dvec3 sum_by_law(const CuttingStep& step, const RemovedVoxels& removed,
                                                    const ChipWeights& weights) {
    return step.has_edge_force ? sum_with<true>(step, removed, weights)
                               : sum_with<false>(step, removed, weights);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fill_avx2(const CuttingStep& step, const RemovedVoxels& removed,
                                       const ChipWeights& weights, ChipForces& out) {
    fill_by_law(step, removed, weights, out);
}

[[gnu::target("avx2")]] glm::dvec3 sum_avx2(const CuttingStep& step, const RemovedVoxels& removed,
                                            const ChipWeights& weights) {
    return sum_by_law(step, removed, weights);
}
#endif

}  // namespace

CuttingStep::CuttingStep(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& middle,
                         double spacing, double elapsed, const glm::dvec3& path_mm,
                         const BurrProfile* head_profile)
    : frame(burr_frame(spindle_axis)),
      middle_voxels(middle),
      radius_voxels(burr.radius_mm() / spacing),
      spacing_mm(spacing),
      coefficients(glm::dvec3(burr.sigma(), 1.0, 1.0) * burr.cutting_coefficients_n_per_mm2),
      elapsed_s(elapsed),
      // V / r in units of the spacing: h^3 / (r h) = h^2 / r.
      newton_per_unit(spacing * spacing / (2.0 * std::numbers::pi * burr.spindle_rev_per_s * elapsed)),
      has_edge_force(burr.has_edge_force() && glm::dot(path_mm, path_mm) > 0.0),
      edge_coefficients_n_per_mm(glm::dvec3(burr.sigma(), 1.0, 1.0) * burr.edge_coefficients_n_per_mm),
      path_direction(0.0f),
      per_full_chip_mm(0.0f),
      half_path_voxels(static_cast<float>(0.5 * glm::length(path_mm) / spacing)),
      head(head_profile) {
    if (!has_edge_force) return;
    const double path = glm::length(path_mm);
    path_direction = glm::vec3(glm::transpose(frame) * path_mm / path);
    per_full_chip_mm = static_cast<float>(burr.edges * burr.spindle_rev_per_s * elapsed / path);
}

void chip_forces(const CuttingStep& step, const RemovedVoxels& removed, const ChipWeights& weights,
                 [[maybe_unused]] InstructionSet instructions, ChipForces& out) noexcept {
    if (step.head != nullptr) return head_forces(step, removed, weights, out);
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return fill_avx2(step, removed, weights, out);
#endif
    fill_by_law(step, removed, weights, out);
}

glm::dvec3 sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              const ChipWeights& weights,
                              [[maybe_unused]] InstructionSet instructions) noexcept {
    if (step.head != nullptr) return sum_of_head_forces(step, removed, weights);
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return sum_avx2(step, removed, weights);
#endif
    return sum_by_law(step, removed, weights);
}

}  // namespace osteomill
