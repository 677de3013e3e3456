#include "haptic_server/milling/engagement.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "haptic_server/milling/burr_frame.h"
#include "haptic_server/milling/chip_force.h"

namespace osteomill {

namespace {

/// Interleaves the bits of a direction's eighths, so that neighbours in the list are neighbours on the
/// sphere.
unsigned place_on_sphere(const glm::dvec3& normal) {
    const glm::uvec3 eighth(glm::min(glm::floor(4.0 * (normal + 1.0)), glm::dvec3(7.0)));
    unsigned place = 0;
    for (unsigned bit = 0; bit < 3; ++bit)
        place |= (eighth.x >> bit & 1u) << (3 * bit) | (eighth.y >> bit & 1u) << (3 * bit + 1) |
                 (eighth.z >> bit & 1u) << (3 * bit + 2);
    return place;
}

}  // namespace

EngagementProbe::EngagementProbe(const Burr& burr, double spacing_mm)
    : radius_mm_(burr.radius_mm()), bricks_(burr.radius_mm() / spacing_mm + reach_voxels + 2.0) {
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
        const double r_mm = std::max(radius_mm_ * sin_kappa, 0.5 * disc_radius_voxels * spacing_mm);
        const glm::dvec3 cutting = -(burr.sigma() * k.x * e_psi + k.y * normal + k.z * e_kappa) *
                                   patch_area_mm2_ / (2.0 * std::numbers::pi * r_mm * burr.spindle_rev_per_s);
        patches_.push_back({normal, cutting});
    }
    // Samples of neighbours read the same bricks.
    std::stable_sort(patches_.begin(), patches_.end(), [](const Patch& a, const Patch& b) {
        return place_on_sphere(a.normal) < place_on_sphere(b.normal);
    });
}

void EngagementProbe::sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                             Engagement& out) noexcept {
    out.burr_position_mm = position_mm;
    out.count = 0;
    const double h = bone.grid().spacing_mm;
    out.spacing_mm = h;
    const glm::dvec3 centre = to_voxel_coordinates(bone.grid(), position_mm);
    const double radius = radius_mm_ / h;
    // Stiffness is read one voxel farther in than the surface may be.
    if (!bricks_.gather(bone, centre, radius + reach_voxels + 1.0)) return;

    const glm::dmat3 frame = burr_frame(spindle_axis);
    const glm::dvec3 base(bricks_.base());
    const glm::vec3 place_of_centre(centre - base);
    constexpr std::array<float, 4> offsets_voxels{-static_cast<float>(reach_voxels), -0.5f, 0.5f,
                                                  static_cast<float>(reach_voxels)};
    constexpr float half = 127.5f;
    for (const Patch& patch : patches_) {
        const glm::dvec3 normal = frame * patch.normal;
        const glm::vec3 outward(normal);
        const glm::vec3 surface = place_of_centre + static_cast<float>(radius) * outward;
        float inner_offset = offsets_voxels[0];
        float inner = 0.0f;
        for (std::size_t i = 0; i < offsets_voxels.size(); ++i) {
            const float offset = offsets_voxels[i];
            const float fraction = bricks_.fraction(surface + offset * outward);
            if (fraction < half) {
                inner_offset = offset;
                inner = fraction;
                continue;
            }
            const float crossing =
                i == 0 ? offset
                       : inner_offset + (offset - inner_offset) * (half - inner) / (fraction - inner);
            // Stiffness one voxel into the bone, where no partial voxel dilutes it.
            double stiffness = bricks_.stiffness(surface + (crossing + 1.0f) * outward);
            if (stiffness == 0.0) stiffness = bricks_.stiffness(surface + offset * outward);
            out.patches[out.count++] = {normal, static_cast<double>(crossing) * h,
                                        stiffness * (frame * patch.cutting_n_s_per_mm), patch_area_mm2_};
            break;
        }
    }
}

}  // namespace osteomill
