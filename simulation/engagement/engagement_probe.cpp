#include "simulation/engagement/engagement_probe.h"

#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

/// Bone that begins no farther than this before uncut bone is a wall.
constexpr float wall_from_voxels = 0.5f;
/// The half level of a rim's fractions lies so far behind it. Nothing cuts what a burr enters there, so a
/// wall begins that much before uncut bone, on the safe side of a flat one.
constexpr double rim_recedes_voxels = 0.4;

}  // namespace

EngagementProbe::EngagementProbe(const Burr& burr, double spacing_mm, const EdgeShares& edge_shares,
                                 const UncutTissues& uncut)
    : radius_mm_(burr.radius_mm()),
      has_edge_force_(burr.has_edge_force()),
      edge_shares_(edge_shares),
      uncut_(uncut),
      patches_(burr_patches(burr, spacing_mm)),
      bounding_radius_mm_(burr.is_ball() ? burr.radius_mm()
                                         : BurrProfile(burr.head, burr.diameter_mm).bounding_radius()),
      crossings_(patches_, spacing_mm),
      bricks_(bounding_radius_mm_ / spacing_mm + Engagement::reach_voxels + 2.0),
      shank_(burr) {
    if (!burr.is_ball()) {
        const BurrProfile head(burr.head, burr.diameter_mm);
        middle_height_mm_ = 0.5 * (head.tip_height() + head.top_height());
        has_beside_ = true;
    }
}

void EngagementProbe::sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                             double speed_share, InsideBurr inside, Engagement& out) noexcept {
    sample_burr(bone, position_mm, spindle_axis, speed_share, inside, out);
    shank_.sample(bone, position_mm, spindle_axis, out);
}

void EngagementProbe::sample_burr(const Bone& bone, const glm::dvec3& position_mm,
                                  const glm::dvec3& spindle_axis, double speed_share, InsideBurr inside,
                                  Engagement& out) noexcept {
    out.burr_position_mm = position_mm;
    out.count = 0;
    const double h = bone.grid().spacing_mm;
    out.spacing_mm = h;
    out.has_edge_force = has_edge_force_;
    out.has_walls = false;
    const glm::dvec3 centre = to_voxel_coordinates(bone.grid(), position_mm);
    const double radius = radius_mm_ / h;
    const glm::dvec3 middle = centre + middle_height_mm_ / h * spindle_axis;
    // Stiffness is read one voxel farther in than the surface may be.
    if (!bricks_.gather(bone, middle, bounding_radius_mm_ / h + Engagement::reach_voxels + 1.0)) return;

    const glm::dmat3 frame = burr_frame(spindle_axis);
    const glm::vec3 centre_in_bricks(centre - glm::dvec3(bricks_.base()));
    const auto radius_voxels = static_cast<float>(radius);
    for (const PatchCrossing& crossing :
         crossings_.find(bricks_, glm::mat3(frame), centre_in_bricks, radius_voxels, inside)) {
        const BurrPatch& patch = patches_[static_cast<std::size_t>(crossing.patch)];
        const glm::dvec3 normal = frame * patch.normal;
        const glm::vec3 outward(normal);
        glm::vec3 surface = centre_in_bricks + radius_voxels * outward;
        if (has_beside_) surface += glm::vec3(frame * patch.beside_mm / h);
        // Stiffness one voxel into the bone, where no partial voxel dilutes it.
        double stiffness = bricks_.stiffness(surface + (crossing.offset_voxels + 1.0f) * outward);
        if (stiffness == 0.0) stiffness = bricks_.stiffness(surface + crossing.bone_offset_voxels * outward);
        const auto share = static_cast<double>(crossing.share);
        stiffness *= share;
        // Field by field: a whole patch put together first would be read before its parts are stored.
        EngagedPatch& engaged = out.patches[out.count++];
        engaged.normal = normal;
        engaged.gap_mm = static_cast<double>(crossing.offset_voxels) * h;
        engaged.cutting_n_s_per_mm = stiffness / speed_share * (frame * patch.cutting_n_s_per_mm);
        engaged.edge_n = glm::dvec3(0.0);
        engaged.area_mm2 = share * patch.area_mm2;
        engaged.is_wall = false;
        if (uncut_.has_any && is_uncut(surface, outward, crossing)) {
            engaged.is_wall = out.has_walls = true;
            engaged.gap_mm += (voxels_over_uncut(surface, outward, crossing) - rim_recedes_voxels) * h;
            engaged.cutting_n_s_per_mm = glm::dvec3(0.0);
        } else if (has_edge_force_) {
            const std::uint8_t label = bricks_.tissue(surface + (crossing.offset_voxels + 1.0f) * outward);
            engaged.edge_n =
                stiffness * static_cast<double>(edge_shares_.of_label[label]) * (frame * patch.edge_n);
        }
    }
}

bool EngagementProbe::is_uncut(const glm::vec3& surface, const glm::vec3& outward,
                               const PatchCrossing& crossing) const noexcept {
    // The label is read where bone begins, not behind: a layer on top of uncut bone is still to be cut.
    return uncut_.of_label[bricks_.tissue(surface + (crossing.offset_voxels + wall_from_voxels) * outward)];
}

double EngagementProbe::voxels_over_uncut(const glm::vec3& surface, const glm::vec3& outward,
                                          const PatchCrossing& crossing) const noexcept {
    constexpr int steps = 5;
    constexpr float step_voxels = wall_from_voxels / steps;
    for (int i = 1; i < steps; ++i) {
        const float ahead = crossing.offset_voxels + static_cast<float>(i) * step_voxels;
        if (uncut_.of_label[bricks_.tissue(surface + ahead * outward)])
            return static_cast<double>(static_cast<float>(i - 1) * step_voxels);
    }
    return static_cast<double>(wall_from_voxels - step_voxels);
}

}  // namespace osteomill
