#include "simulation/cutting_force/chip_force.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "common/scene/burr.h"
#include "simulation/carving/simd.h"
#include "simulation/cutting_force/axis_singularity_kernel.h"
#include "simulation/cutting_force/head_force.h"

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
          path_direction(simd::floats3(step.path_direction)),
          half_path(simd::floats(step.half_path_voxels)),
          line_lost(simd::floats(step.line_lost)) {}

    Floats3 x_axis, y_axis, z_axis;  // of the burr
    Floats3 middle;                  // counted from the batch's base
    Floats tangential, radial, axial;
    Floats3 path_direction;  // burr axes; of edges, and so is half_path
    Floats half_path;
    Floats line_lost;
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
template <bool of_edges>
[[gnu::always_inline]] inline Floats3 forces_of(const Constants& c, const Floats3& position,
                                                const Floats& removed) {
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
    AxisKernel<Floats> mean = any_near ? axis_kernel(r_squared, per_r) : far_axis_kernel(per_r);

    Floats weight = removed;
    if constexpr (of_edges) {
        const Floats turn = simd::larger(c.half_path * per_distance, simd::floats(least_turn));
        weight /= edge_advance(dot(position, c.path_direction) * per_distance, turn);
        mean.swirl += c.line_lost * swirl_lost_at_line(r_squared);
    }
    const Floats swirl = weight * mean.swirl;
    const Floats outward = c.axial * cos_kappa * swirl + c.radial * per_distance * weight * mean.outward;
    return {c.tangential * swirl * y - outward * x, -c.tangential * swirl * x - outward * y,
            weight * (c.radial * cos_kappa * mean.inverse - c.axial * per_distance)};
}

template <bool of_edges>
[[gnu::always_inline]] inline void fill_with(const CuttingStep& step, const RemovedVoxels& removed,
                                             std::span<const float> weights, ChipForces& out) {
    const Constants c(step, removed.base);
    for (std::size_t i = 0; i < removed.padded_count(); i += simd::width) {
        const Floats3 position = positions_of(c, &removed.x[i], &removed.y[i], &removed.z[i]);
        const Floats3 force = forces_of<of_edges>(c, position, simd::load<Floats>(weights.data() + i));
        simd::store(&out.x[i], position.x);
        simd::store(&out.y[i], position.y);
        simd::store(&out.z[i], position.z);
        simd::store(&out.force_x[i], force.x);
        simd::store(&out.force_y[i], force.y);
        simd::store(&out.force_z[i], force.z);
    }
}

template <bool of_edges>
[[gnu::always_inline]] inline glm::dvec3 sum_with(const CuttingStep& step, const RemovedVoxels& removed,
                                                  std::span<const float> weights) {
    const Constants c(step, removed.base);
    Floats3 sum{};
    for (std::size_t i = 0; i < removed.padded_count(); i += simd::width) {
        const Floats3 force =
            forces_of<of_edges>(c, positions_of(c, &removed.x[i], &removed.y[i], &removed.z[i]),
                                simd::load<Floats>(weights.data() + i));
        sum.x += force.x;
        sum.y += force.y;
        sum.z += force.z;
    }
    return {simd::sum(sum.x), simd::sum(sum.y), simd::sum(sum.z)};
}

[[gnu::always_inline]] inline void fill_by_law(const CuttingStep& step, const RemovedVoxels& removed,
                                               std::span<const float> weights, ChipForces& out) {
    step.is_of_edges ? fill_with<true>(step, removed, weights, out)
                     : fill_with<false>(step, removed, weights, out);
}

[[gnu::always_inline]] inline glm::dvec3 sum_by_law(const CuttingStep& step, const RemovedVoxels& removed,
                                                    std::span<const float> weights) {
    return step.is_of_edges ? sum_with<true>(step, removed, weights)
                            : sum_with<false>(step, removed, weights);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fill_avx2(const CuttingStep& step, const RemovedVoxels& removed,
                                       std::span<const float> weights, ChipForces& out) {
    fill_by_law(step, removed, weights, out);
}

[[gnu::target("avx2")]] glm::dvec3 sum_avx2(const CuttingStep& step, const RemovedVoxels& removed,
                                            std::span<const float> weights) {
    return sum_by_law(step, removed, weights);
}
#endif

}  // namespace

CuttingStep::CuttingStep(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& middle,
                         double spacing, double elapsed, const BurrProfile* head_profile)
    : frame(burr_frame(spindle_axis)),
      middle_voxels(middle),
      spacing_mm(spacing),
      coefficients(glm::dvec3(burr.sigma(), 1.0, 1.0) * burr.cutting_coefficients_n_per_mm2),
      elapsed_s(elapsed),
      // V / r in units of the spacing: h^3 / (r h) = h^2 / r.
      newton_per_unit(spacing * spacing / (2.0 * std::numbers::pi * burr.spindle_rev_per_s * elapsed)),
      head(head_profile) {}

CuttingStep CuttingStep::of_edges(const Burr& burr, const glm::dvec3& from_voxels,
                                  const glm::dvec3& path_voxels) const {
    CuttingStep step = *this;
    const double path = glm::length(path_voxels);
    step.middle_voxels = from_voxels + 0.5 * path_voxels;
    step.coefficients = glm::dvec3(burr.sigma(), 1.0, 1.0) * burr.edge_coefficients_n_per_mm;
    // V / (d r): h^3 / (d h r h) = h / (d r).
    step.newton_per_unit = spacing_mm * burr.edges / (2.0 * std::numbers::pi * path);
    step.is_of_edges = true;
    step.path_direction = glm::vec3(glm::transpose(frame) * path_voxels / path);
    step.half_path_voxels = static_cast<float>(0.5 * path);
    // If a ball's path is off the plane across its spindle, the face ends that far from the axis.
    step.line_lost = head != nullptr ? 0.0f
                                     : share_lost_at_line(static_cast<float>(burr.radius_mm() / spacing_mm) *
                                                          std::abs(step.path_direction.z));
    return step;
}

void chip_forces(const CuttingStep& step, const RemovedVoxels& removed, std::span<const float> weights,
                 [[maybe_unused]] InstructionSet instructions, ChipForces& out) noexcept {
    if (step.head != nullptr) return head_forces(step, removed, weights, out);
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return fill_avx2(step, removed, weights, out);
#endif
    fill_by_law(step, removed, weights, out);
}

glm::dvec3 sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights,
                              [[maybe_unused]] InstructionSet instructions) noexcept {
    if (step.head != nullptr) return sum_of_head_forces(step, removed, weights);
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return sum_avx2(step, removed, weights);
#endif
    return sum_by_law(step, removed, weights);
}

}  // namespace osteomill
