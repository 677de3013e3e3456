#include "haptic_server/milling/engagement.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "haptic_server/milling/burr_frame.h"
#include "haptic_server/milling/chip_force.h"

namespace osteomill {

namespace {

/// Fraction (0 to 1) at continuous voxel coordinates, trilinear between voxel centres.
double trilinear_fraction(const Bone& bone, const glm::dvec3& at) {
    const glm::dvec3 base = glm::floor(at);
    const glm::ivec3 first(base);
    const glm::dvec3 w = at - base;
    std::array<double, 8> corner{};
    const glm::ivec3 brick = first >> 4;
    const bool within_one_brick =
        contains(bone.grid(), first) && brick == ((first + 1) >> 4) && contains(bone.grid(), first + 1);
    if (within_one_brick) {
        const std::int32_t slot = bone.slot(brick);
        if (slot == BoneContent::no_slot) return 0.0;
        const auto fractions = bone.fractions(slot);
        const std::size_t o = offset_in_brick(first);
        corner = {static_cast<double>(fractions[o]),       static_cast<double>(fractions[o + 1]),
                  static_cast<double>(fractions[o + 16]),  static_cast<double>(fractions[o + 17]),
                  static_cast<double>(fractions[o + 256]), static_cast<double>(fractions[o + 257]),
                  static_cast<double>(fractions[o + 272]), static_cast<double>(fractions[o + 273])};
    } else {
        for (int i = 0; i < 8; ++i)
            corner[static_cast<std::size_t>(i)] =
                bone.fraction_at(first + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2));
    }
    const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
    const double z0 = mix(mix(corner[0], corner[1], w.x), mix(corner[2], corner[3], w.x), w.y);
    const double z1 = mix(mix(corner[4], corner[5], w.x), mix(corner[6], corner[7], w.x), w.y);
    return mix(z0, z1, w.z) / 255.0;
}

/// Whether any brick within the ball's bounding box holds bone.
bool any_bone_near(const Bone& bone, const glm::dvec3& centre_voxels, double radius_voxels) {
    const glm::dvec3 last_voxel(bone.grid().size_voxels - 1);
    const glm::dvec3 low = centre_voxels - radius_voxels;
    const glm::dvec3 high = centre_voxels + radius_voxels;
    if (glm::any(glm::lessThan(high, glm::dvec3(0.0))) || glm::any(glm::greaterThan(low, last_voxel)))
        return false;
    const glm::ivec3 first(glm::max(low, glm::dvec3(0.0)));
    const glm::ivec3 last(glm::min(high, last_voxel));
    for (int z = first.z >> 4; z <= last.z >> 4; ++z)
        for (int y = first.y >> 4; y <= last.y >> 4; ++y)
            for (int x = first.x >> 4; x <= last.x >> 4; ++x)
                if (bone.slot({x, y, z}) != BoneContent::no_slot) return true;
    return false;
}

}  // namespace

EngagementProbe::EngagementProbe(const Burr& burr, double spacing_mm) : radius_mm_(burr.radius_mm()) {
    const double sphere_area_mm2 = 4.0 * std::numbers::pi * radius_mm_ * radius_mm_;
    const double patch_edge_mm = 2.0 * spacing_mm;
    const auto count = static_cast<std::size_t>(std::clamp(sphere_area_mm2 / (patch_edge_mm * patch_edge_mm),
                                                           128.0, double{Engagement::max_patches}));
    patch_area_mm2_ = sphere_area_mm2 / static_cast<double>(count);

    const glm::dvec3 k = burr.cutting_coefficients_n_per_mm2;
    const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
    patches_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = -1.0 + (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double sin_kappa = std::sqrt(1.0 - z * z);
        const double psi = golden_angle_rad * static_cast<double>(i);
        const glm::dvec3 normal(std::cos(psi) * sin_kappa, std::sin(psi) * sin_kappa, z);
        const glm::dvec3 e_psi(-std::sin(psi), std::cos(psi), 0.0);
        const glm::dvec3 e_kappa(std::cos(psi) * -z, std::sin(psi) * -z, sin_kappa);
        const double r_mm = std::max(radius_mm_ * sin_kappa, smallest_radius_voxels * spacing_mm);
        const glm::dvec3 cutting = -(burr.sigma() * k.x * e_psi + k.y * normal + k.z * e_kappa) *
                                   patch_area_mm2_ / (2.0 * std::numbers::pi * r_mm * burr.spindle_rev_per_s);
        patches_.push_back({normal, cutting});
    }
}

void EngagementProbe::sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                             Engagement& out) const {
    out.burr_position_mm = position_mm;
    out.count = 0;
    const double h = bone.grid().spacing_mm;
    out.spacing_mm = h;
    const glm::dvec3 centre = to_voxel_coordinates(bone.grid(), position_mm);
    const double radius = radius_mm_ / h;
    if (!any_bone_near(bone, centre, radius + reach_voxels + 1.0)) return;

    const glm::dmat3 frame = burr_frame(spindle_axis);
    constexpr std::array<double, 4> offsets_voxels{-reach_voxels, -0.5, 0.5, reach_voxels};
    for (const Patch& patch : patches_) {
        const glm::dvec3 normal = frame * patch.normal;
        double inner_offset = offsets_voxels[0];
        double inner = 0.0;
        for (std::size_t i = 0; i < offsets_voxels.size(); ++i) {
            const double offset = offsets_voxels[i];
            const double fraction = trilinear_fraction(bone, centre + (radius + offset) * normal);
            if (fraction < 0.5) {
                inner_offset = offset;
                inner = fraction;
                continue;
            }
            const double crossing =
                i == 0 ? offset : inner_offset + (offset - inner_offset) * (0.5 - inner) / (fraction - inner);
            // Stiffness one voxel into the bone, where no partial voxel dilutes it.
            const glm::dvec3 within = centre + (radius + crossing + 1.0) * normal;
            double stiffness = bone.stiffness_at(glm::ivec3(glm::floor(within + 0.5)));
            if (stiffness == 0.0)
                stiffness =
                    bone.stiffness_at(glm::ivec3(glm::floor(centre + (radius + offset) * normal + 0.5)));
            out.patches[out.count++] = {normal, crossing * h, stiffness * (frame * patch.cutting_n_s_per_mm),
                                        patch_area_mm2_};
            break;
        }
    }
}

}  // namespace osteomill
