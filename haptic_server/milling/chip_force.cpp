#include "haptic_server/milling/chip_force.h"

#include <cmath>
#include <numbers>

#include "common/bone/bone.h"
#include "haptic_server/milling/axis_means.h"
#include "haptic_server/milling/burr_frame.h"
#include "haptic_server/milling/lanes.h"

namespace osteomill {

namespace {

using lanes::Floats;

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

/// Eight places in burr axes.
struct EightPlaces {
    Floats x, y, z;
};

/// Of the voxels at (*vx, *vy, *vz) and the seven that follow.
[[gnu::always_inline]] inline EightPlaces places_of(const Constants& c, const float* vx, const float* vy,
                                                    const float* vz) {
    const Floats wx = lanes::load<Floats>(vx) - c.middle_x;
    const Floats wy = lanes::load<Floats>(vy) - c.middle_y;
    const Floats wz = lanes::load<Floats>(vz) - c.middle_z;
    return {c.xx * wx + c.xy * wy + c.xz * wz, c.yx * wx + c.yy * wy + c.yz * wz,
            c.zx * wx + c.zy * wy + c.zz * wz};
}

/// And their forces.
struct EightForces {
    Floats x, y, z;
    Floats force_x, force_y, force_z;
    bool any_near;
};

/// `near_squared`: how near to the axis, squared, a voxel is for which the means of axis_means.h are asked.
[[gnu::always_inline]] inline EightForces forces_of(const Constants& c, const EightPlaces& places,
                                                    const Floats& weight,
                                                    float near_squared = axis_disc_voxels *
                                                                         axis_disc_voxels) {
    const Floats& x = places.x;
    const Floats& y = places.y;
    const Floats& z = places.z;
    const Floats r_squared = x * x + y * y;
    const Floats distance_squared = r_squared + z * z;
    // No voxel of a crescent is that near the centre; padding may be.
    const Floats distance =
        lanes::square_root(distance_squared < 0.25f ? lanes::floats(0.25f) : distance_squared);
    const Floats r = lanes::square_root(r_squared < 0.01f ? lanes::floats(0.01f) : r_squared);
    const Floats per_both = 1.0f / (distance * r);  // one division for two
    const Floats per_distance = per_both * r;
    const Floats cos_kappa = -z * per_distance;
    const Floats per_r = per_both * distance;
    const bool any_near = lanes::any(r_squared < near_squared);  // few are
    const AxisMeans<Floats> mean = any_near ? axis_means(r_squared, per_r) : far_axis_means(per_r);

    const Floats swirl = weight * mean.swirl;
    const Floats outward = c.axial * cos_kappa * swirl + c.radial * per_distance * weight * mean.outward;
    return {x,
            y,
            z,
            c.tangential * swirl * y - outward * x,
            -c.tangential * swirl * x - outward * y,
            weight * (c.radial * cos_kappa * mean.inverse - c.axial * per_distance),
            any_near};
}

[[gnu::always_inline]] inline void fill_with(const Constants& constants, std::size_t count, const float* vx,
                                             const float* vy, const float* vz, const float* weights,
                                             ChipForces& out) {
    const Constants c = constants;
    for (std::size_t i = 0; i < count; i += lanes::width) {
        const EightForces f =
            forces_of(c, places_of(c, vx + i, vy + i, vz + i), lanes::load<Floats>(weights + i));
        lanes::store(&out.x[i], f.x);
        lanes::store(&out.y[i], f.y);
        lanes::store(&out.z[i], f.z);
        lanes::store(&out.force_x[i], f.force_x);
        lanes::store(&out.force_y[i], f.force_y);
        lanes::store(&out.force_z[i], f.force_z);
    }
}

[[gnu::always_inline]] inline glm::dvec3 sum_with(const Constants& constants, std::size_t count,
                                                  const float* vx, const float* vy, const float* vz,
                                                  const float* weights) {
    const Constants c = constants;
    Floats x{};
    Floats y{};
    Floats z{};
    for (std::size_t i = 0; i < count; i += lanes::width) {
        const EightForces f =
            forces_of(c, places_of(c, vx + i, vy + i, vz + i), lanes::load<Floats>(weights + i));
        x += f.force_x;
        y += f.force_y;
        z += f.force_z;
    }
    return {lanes::sum(x), lanes::sum(y), lanes::sum(z)};
}

/// TipSearch as plain floats.
struct TipConstants {
    float radius;
    float reach_squared;
    float per_level_x, per_level_y;
    float per_depth_x, per_depth_y;
    bool moves;
};

TipConstants tip_constants(const CuttingStep& step, const TipSearch& tip) {
    const auto radius = static_cast<float>(step.radius_voxels);
    // As far off the axis as a voxel can be that is within the disc once it is moved to the burr's surface.
    const float reach = tip_disc_voxels * (1.0f + 2.0f / radius);
    return {radius,
            reach * reach,
            tip.per_level.x,
            tip.per_level.y,
            tip.per_depth.x,
            tip.per_depth.y,
            tip.per_level != glm::vec2(0.0f)};
}

struct EightTipSums {
    Floats volume{};
    Floats stiffness{};
    Floats x{};
    Floats y{};
    Floats force_x{};
    Floats force_y{};
    Floats force_z{};
    Floats moved_x{};
    Floats moved_y{};
    Floats moved_z{};
};

/// What the voxels from `first` on kept, in 255 steps; 0 for those that lost nothing.
[[gnu::always_inline]] inline Floats kept_by(const RemovedVoxels& removed, std::size_t first) {
    Floats kept{};
    for (std::size_t lane = 0; lane < lanes::width; ++lane) {
        const std::size_t i = first + lane;
        if (removed.codes[i] > 0.0f)
            kept[lane] = static_cast<float>(
                removed.bone->fractions(removed.slot[i])[static_cast<std::size_t>(removed.offset[i])]);
    }
    return kept;
}

/// Adds the voxels from `first` on to the sums over the disc.
[[gnu::always_inline]] inline void search_tip(const Constants& c, const TipConstants& tip,
                                              const RemovedVoxels& removed, std::size_t first,
                                              const EightPlaces& places, const Floats& weight,
                                              EightTipSums& sums) {
    constexpr float per_code = 1.0f / 255.0f;
    constexpr float per_disc_squared = 1.0f / (tip_disc_voxels * tip_disc_voxels);
    const Floats r_squared = places.x * places.x + places.y * places.y;
    const Floats distance_squared = r_squared + places.z * places.z;
    const Floats per_distance =
        1.0f / lanes::square_root(distance_squared < 0.25f ? lanes::floats(0.25f) : distance_squared);
    const Floats to_surface = tip.radius * per_distance;
    const Floats in_disc = 1.0f - r_squared * to_surface * to_surface * per_disc_squared;
    const auto is_in_disc = (in_disc > 0.0f) & (places.z < 0.0f);

    const Floats counted = is_in_disc ? in_disc : Floats{};
    const Floats lost = lanes::load<Floats>(&removed.codes[first]);
    const Floats volume = counted * (per_code * lost);
    sums.volume += volume;
    sums.stiffness += counted * weight;
    sums.x += volume * (places.x * to_surface);
    sums.y += volume * (places.y * to_surface);
    const EightForces listed = forces_of(c, places, weight);
    sums.force_x += counted * listed.force_x;
    sums.force_y += counted * listed.force_y;
    sums.force_z += counted * listed.force_z;
    if (!tip.moves) return;

    const Floats level = is_in_disc ? per_code * (kept_by(removed, first) + 0.5f * lost) - 0.5f : Floats{};
    // Only a leap has deeper ones.
    constexpr float deepest = 1.5f;
    Floats depth = is_in_disc ? tip.radius - distance_squared * per_distance : Floats{};
    depth = depth > deepest ? lanes::floats(deepest) : depth;
    depth = depth < -deepest ? lanes::floats(-deepest) : depth;
    const EightForces moved =
        forces_of(c,
                  {places.x + tip.per_level_x * level + tip.per_depth_x * depth,
                   places.y + tip.per_level_y * level + tip.per_depth_y * depth, places.z},
                  weight);
    sums.moved_x += moved.force_x - listed.force_x;
    sums.moved_y += moved.force_y - listed.force_y;
    sums.moved_z += moved.force_z - listed.force_z;
}

[[gnu::always_inline]] inline ChipSums sum_and_search_with(const Constants& constants,
                                                           const TipConstants& tip_constants,
                                                           const RemovedVoxels& removed,
                                                           const float* weights) {
    const Constants c = constants;
    Floats x{};
    Floats y{};
    Floats z{};
    Floats all{};
    Floats place_x{};
    Floats place_y{};
    Floats place_z{};
    std::array<std::uint16_t, RemovedVoxels::capacity / lanes::width> near_tip;  // first voxels of eights
    std::size_t near_count = 0;
    const float reach_squared = tip_constants.reach_squared;
    for (std::size_t i = 0; i < removed.padded_count(); i += lanes::width) {
        const EightPlaces places = places_of(c, &removed.x[i], &removed.y[i], &removed.z[i]);
        const Floats weight = lanes::load<Floats>(weights + i);
        const EightForces f = forces_of(c, places, weight, reach_squared);
        near_tip[near_count] = static_cast<std::uint16_t>(i);
        near_count += f.any_near ? 1 : 0;
        x += f.force_x;
        y += f.force_y;
        z += f.force_z;
        const Floats lost = lanes::load<Floats>(&removed.codes[i]);
        all += weight;
        place_x += lost * places.x;
        place_y += lost * places.y;
        place_z += lost * places.z;
    }
    const TipConstants tip = tip_constants;
    EightTipSums seen;
    for (std::size_t n = 0; n < near_count; ++n) {
        const std::size_t i = near_tip[n];
        const EightPlaces places = places_of(c, &removed.x[i], &removed.y[i], &removed.z[i]);
        search_tip(c, tip, removed, i, places, lanes::load<Floats>(weights + i), seen);
    }
    return {{lanes::sum(x), lanes::sum(y), lanes::sum(z)},
            {.volume = lanes::sum(seen.volume),
             .moment = {lanes::sum(seen.x), lanes::sum(seen.y)},
             .stiffness = lanes::sum(seen.stiffness),
             .force = {lanes::sum(seen.force_x), lanes::sum(seen.force_y), lanes::sum(seen.force_z)},
             .moved = {lanes::sum(seen.moved_x), lanes::sum(seen.moved_y), lanes::sum(seen.moved_z)},
             .all = lanes::sum(all),
             .places = glm::dvec3(lanes::sum(place_x), lanes::sum(place_y), lanes::sum(place_z)) / 255.0}};
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] ChipSums sum_and_search_avx2(const Constants& c, const TipConstants& tip,
                                                     const RemovedVoxels& removed, const float* weights) {
    return sum_and_search_with(c, tip, removed, weights);
}

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

ChipSums sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                            std::span<const float> weights, [[maybe_unused]] InstructionSet instructions,
                            const TipSearch& tip) noexcept {
    const Constants c = constants(step, removed.base);
    const TipConstants t = tip_constants(step, tip);
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) return sum_and_search_avx2(c, t, removed, weights.data());
#endif
    return sum_and_search_with(c, t, removed, weights.data());
}

}  // namespace osteomill
