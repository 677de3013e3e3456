#include "simulation/force_models/hertz_contact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/scene/burr.h"
#include "simulation/force_models/ball_rows.h"

namespace osteomill {

namespace {

/// Sums over the bone within a burr, in units of voxels.
struct Moments {
    double volume = 0.0;    ///< M
    glm::dvec3 first{0.0};  ///< M_1
    double weighted_by_stiffness = 0.0;
    double covered = 0.0;  ///< of the voxels that hold any bone
};

Moments moments_of(const Bone& bone, const Ball& ball) noexcept {
    Moments moments;
    visit_immersed(bone, ball,
                   [&](const glm::dvec3& from_centre, double cover, double fraction, std::size_t offset,
                       std::int32_t slot) {
                       const double weight = cover * fraction;
                       moments.volume += weight;
                       moments.first += weight * from_centre;
                       moments.weighted_by_stiffness += weight * bone.content().stiffness_in(slot, offset);
                       moments.covered += cover;
                   });
    return moments;
}

}  // namespace

double cap_height(double volume, double radius) {
    // h = R (1 + 2 cos t) turns pi h^2 (R - h/3) into (2/3) pi R^3 (1 - cos 3t).
    const double cos_3t = 1.0 - 1.5 * volume / (std::numbers::pi * radius * radius * radius);
    const double t = (2.0 * std::numbers::pi - std::acos(std::clamp(cos_3t, -1.0, 1.0))) / 3.0;
    return std::max(0.0, radius * (1.0 + 2.0 * std::cos(t)));
}

HertzContact::HertzContact(const HertzSettings& settings) : settings_(settings) {
    for (std::size_t ring = 0; ring < rings; ++ring) {
        // Within x lies 1 - (1 - x^2)^(3/2) of the force.
        const double share = (static_cast<double>(ring) + 0.5) / rings;
        const double x = std::sqrt(1.0 - std::pow(1.0 - share, 2.0 / 3.0));
        for (std::size_t spoke = 0; spoke < spokes; ++spoke) {
            const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(spoke) / spokes;
            bearing_points_[ring * spokes + spoke] = x * glm::dvec2(std::cos(angle_rad), std::sin(angle_rad));
        }
    }
}

ContactReaction HertzContact::react(const BurrContact& contact) noexcept {
    const Moments moments = moments_of(contact.bone, {contact.centre_voxels, contact.radius_voxels});
    const double off_centre = glm::length(moments.first);
    if (off_centre == 0.0) return {};

    const glm::dvec3 normal = -moments.first / off_centre;
    const double radius_mm = contact.burr.radius_mm();
    const double depth_mm = contact.spacing_mm() * cap_height(moments.volume, contact.radius_voxels);
    const double stiffness = moments.weighted_by_stiffness / moments.volume;
    const double trust = trust_in_direction(off_centre, moments.volume * contact.radius_voxels);
    const double elastic_n = trust * stiffness * settings_.elasticity_n_per_mm2 * radius_mm * radius_mm *
                             std::pow(depth_mm / radius_mm, 1.5);
    if (!contact.spindle_on) return {.force_n = elastic_n * normal};

    // The burr turns about +axis where sigma is +1.
    const glm::dvec3 spin = contact.burr.sigma() * contact.spindle_axis;
    const double contact_radius_mm = std::min(std::sqrt(depth_mm * radius_mm), radius_mm);
    const glm::dmat3 disc = burr_frame(-normal);  // z into the bone
    glm::dvec3 direction(0.0);
    double arm_mm = 0.0;  // mean distance from the spindle's axis
    for (const glm::dvec2& point : bearing_points_) {
        const glm::dvec2 across = contact_radius_mm * point;
        const double down_mm = std::sqrt(std::max(0.0, radius_mm * radius_mm - glm::dot(across, across)));
        const glm::dvec3 slip = glm::cross(disc * glm::dvec3(across, down_mm), spin);
        const double distance_mm = glm::length(slip);
        arm_mm += distance_mm / (rings * spokes);
        if (distance_mm > 1e-9 * radius_mm) direction += slip / (distance_mm * rings * spokes);
    }
    const double power_mw =
        settings_.friction * elastic_n * 2.0 * std::numbers::pi * contact.burr.spindle_rev_per_s * arm_mm;
    const double covered_mm3 = moments.covered * voxel_volume_mm3(contact.bone.grid());
    return {.force_n = elastic_n * (normal + settings_.friction * direction),
            .erosion_per_s = power_mw / (settings_.erosion_mj_per_mm3 * covered_mm3)};
}

}  // namespace osteomill
