#include "analysis/report/planned_region.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "imaging/picture/smooth_border.h"

namespace osteomill {

namespace {

/// Below zero inside.
double signed_distance_mm(const SphereRegion& sphere, const glm::dvec3& place_mm) {
    return glm::length(place_mm - sphere.centre_mm) - sphere.radius_mm;
}

double signed_distance_mm(const CylinderRegion& cylinder, const glm::dvec3& place_mm) {
    const glm::dvec3 along = glm::normalize(cylinder.to_mm - cylinder.from_mm);
    const double half_mm = 0.5 * glm::length(cylinder.to_mm - cylinder.from_mm);
    const glm::dvec3 from_middle = place_mm - 0.5 * (cylinder.from_mm + cylinder.to_mm);
    const double height_mm = glm::dot(from_middle, along);
    const double beyond_side_mm = glm::length(from_middle - height_mm * along) - cylinder.radius_mm;
    const double beyond_end_mm = std::abs(height_mm) - half_mm;
    if (beyond_side_mm > 0.0 && beyond_end_mm > 0.0) return std::hypot(beyond_side_mm, beyond_end_mm);
    return std::max(beyond_side_mm, beyond_end_mm);
}

int label_of(const SessionInfo& session) {
    if (const auto* tissue = std::get_if<TissueRegion>(&session.plan->region))
        for (const Tissue& known : session.tissues)
            if (known.name == tissue->tissue) return known.label;
    return -1;
}

}  // namespace

PlannedRegion::PlannedRegion(const Bone& bone, const SessionInfo& session)
    : bone_(bone), plan_(*session.plan), label_(label_of(session)), voxels_(bone), surface_({}) {
    const BoneContent& content = bone.content();
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        const BrickFractions fractions = bone.fractions(slot);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (fractions[offset] > 0 && holds(slot, offset, first + voxel_in_brick(offset)))
                voxels_.set(slot, offset);
    }
    if (is_tissue()) surface_ = NearestPlace(voxels_.surface_mm());
}

bool PlannedRegion::holds(std::int32_t slot, std::size_t offset, const glm::ivec3& voxel) const {
    if (is_tissue()) return label_ >= 0 && bone_.content().tissue_in(slot, offset) == label_;
    return distance_mm(centre_of_voxel_mm(bone_.grid(), voxel)) <= 0.0;
}

bool PlannedRegion::has_tissue(const glm::ivec3& voxel) const {
    return contains(bone_.grid(), voxel) && bone_.fraction_at(voxel) > 0 && bone_.tissue_at(voxel) == label_;
}

bool PlannedRegion::holds(const glm::dvec3& place_mm) const {
    if (!is_tissue()) return distance_mm(place_mm) <= 0.0;
    return is_mostly(to_voxel_coordinates(bone_.grid(), place_mm),
                     [&](const glm::ivec3& voxel) { return has_tissue(voxel); });
}

double PlannedRegion::distance_mm(const glm::dvec3& place_mm) const {
    if (const auto* sphere = std::get_if<SphereRegion>(&plan_.region))
        return signed_distance_mm(*sphere, place_mm);
    if (const auto* cylinder = std::get_if<CylinderRegion>(&plan_.region))
        return signed_distance_mm(*cylinder, place_mm);
    return surface_.distance_mm(place_mm).value_or(std::numeric_limits<double>::infinity());
}

}  // namespace osteomill
