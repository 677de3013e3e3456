#include "simulation/force_models/petersik_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "simulation/force_models/bone_surface.h"

namespace osteomill {

PetersikProbe::PetersikProbe(const PetersikSettings& settings) : settings_(settings) {
    if (settings_.surface_points < 2 || settings_.surface_points % 2 != 0)
        throw std::invalid_argument("the surface probe needs an even number of points, 2 at least");
    const auto pairs = static_cast<std::size_t>(settings_.surface_points / 2);
    normals_.reserve(2 * pairs);
    immersed_.reserve(2 * pairs);
    const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; i < pairs; ++i) {
        const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(pairs);
        const double across = std::sqrt(1.0 - z * z);
        const double psi = golden_angle_rad * static_cast<double>(i);
        const glm::dvec3 normal(std::cos(psi) * across, std::sin(psi) * across, z);
        normals_.push_back(normal);
        normals_.push_back(-normal);
    }
}

ContactReaction PetersikProbe::react(const BurrContact& contact) noexcept {
    ContactReaction reaction{.erosion_per_s = settings_.erosion_per_s};
    const double radius = contact.radius_voxels;
    const glm::vec3 centre = contact.in_bricks(contact.centre_voxels);
    const auto point = [&](const glm::dvec3& normal) { return centre + glm::vec3(radius * normal); };

    immersed_.clear();
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (const glm::dvec3& normal : normals_) {
        if (contact.bricks.fraction(point(normal)) < surface_fraction) continue;
        immersed_.push_back(normal);
        const auto length = static_cast<double>(
            length_in_bone(contact.bricks, point(normal), glm::vec3(-normal), static_cast<float>(radius)));
        sum -= length * normal;
        total += length;
    }
    const double strength = glm::length(sum);
    if (strength == 0.0) return reaction;

    const glm::dvec3 direction = sum / strength;
    double depth_voxels = 0.0;
    for (const glm::dvec3& normal : immersed_) {
        const double chord = -2.0 * radius * glm::dot(normal, direction);  // to the burr's far side
        if (chord <= depth_voxels) continue;
        depth_voxels =
            std::max(depth_voxels,
                     static_cast<double>(length_in_bone(contact.bricks, point(normal), glm::vec3(direction),
                                                        static_cast<float>(chord))));
    }
    reaction.force_n = settings_.stiffness_n_per_mm * depth_voxels * contact.spacing_mm() *
                       trust_in_direction(strength, total) * direction;
    return reaction;
}

}  // namespace osteomill
