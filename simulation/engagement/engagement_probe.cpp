#include "simulation/engagement/engagement_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

/// Rings for each cone of a profile: one, and one more wherever the heights of a cone's rings are farthest
/// apart as a ratio.
std::vector<int> rings_by_cone(const ShankProfile& shank, int rings) {
    std::vector<int> counts(shank.size() - 1, 1);
    const auto spread = [&](std::size_t cone) {
        return std::log(shank[cone + 1].height_mm / shank[cone].height_mm) / counts[cone];
    };
    for (int left = rings - static_cast<int>(counts.size()); left > 0; --left) {
        std::size_t widest = 0;
        for (std::size_t cone = 1; cone < counts.size(); ++cone)
            if (spread(cone) > spread(widest)) widest = cone;
        ++counts[widest];
    }
    return counts;
}

/// Distance from a sample at `position`, in voxels, outward along `normal` to the bone, searched from
/// `inmost` (negative) on; nothing if there is none within reach.
std::optional<float> gap_voxels(const BrickNeighbourhood& bricks, const glm::vec3& position,
                                const glm::vec3& normal, float inmost) {
    const std::array<float, 4> offsets{inmost, std::max(inmost, -0.5f), 0.5f,
                                       static_cast<float>(Engagement::reach_voxels)};
    float inner_offset = inmost;
    float inner = 0.0f;
    for (const float offset : offsets) {
        const float fraction = bricks.fraction(position + offset * normal);
        if (fraction >= surface_fraction) {
            if (offset == inmost) return inmost;
            return inner_offset + (offset - inner_offset) * (surface_fraction - inner) / (fraction - inner);
        }
        inner_offset = offset;
        inner = fraction;
    }
    return std::nullopt;
}

}  // namespace

ShankProbe::ShankProbe(const Burr& burr) : bricks_(Engagement::reach_voxels + 1.0) {
    if (burr.shank.empty()) return;
    const std::vector<int> counts = rings_by_cone(burr.shank, rings);
    for (std::size_t cone = 0; cone < counts.size(); ++cone)
        add_cone(burr.shank[cone], burr.shank[cone + 1], counts[cone], burr.radius_mm());
}

void ShankProbe::add_cone(const ShankPoint& low, const ShankPoint& high, int ring_count,
                          double burr_radius_mm) {
    const double rise_mm = high.height_mm - low.height_mm;
    const double widening_mm = high.radius_mm - low.radius_mm;
    const double slant_mm = std::hypot(rise_mm, widening_mm);
    const auto share_at = [&](double ring) {
        const double height_mm = low.height_mm * std::pow(high.height_mm / low.height_mm, ring / ring_count);
        return (height_mm - low.height_mm) / rise_mm;
    };
    for (int ring = 0; ring < ring_count; ++ring) {
        const double from = share_at(ring);
        const double to = share_at(ring + 1.0);
        const double middle = 0.5 * (from + to);
        const double height_mm = low.height_mm + middle * rise_mm;
        const double radius_mm = low.radius_mm + middle * widening_mm;
        const double area_mm2 = 2.0 * std::numbers::pi * radius_mm * (to - from) * slant_mm / samples_a_ring;
        const double turned = next_is_turned_ ? 0.5 : 0.0;
        next_is_turned_ = !next_is_turned_;
        if (std::hypot(height_mm, radius_mm) < burr_radius_mm) continue;
        for (int i = 0; i < samples_a_ring; ++i) {
            const double psi = 2.0 * std::numbers::pi * (i + turned) / samples_a_ring;
            const glm::dvec3 out(std::cos(psi), std::sin(psi), 0.0);
            samples_.push_back({.arm_mm = radius_mm * out + glm::dvec3(0.0, 0.0, height_mm),
                                .normal = (rise_mm * out - glm::dvec3(0.0, 0.0, widening_mm)) / slant_mm,
                                .area_mm2 = area_mm2,
                                .radius_mm = radius_mm});
        }
    }
}

void ShankProbe::sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                        Engagement& out) noexcept {
    out.shank_count = 0;
    if (samples_.empty()) return;
    const double h = bone.grid().spacing_mm;
    const glm::dmat3 frame = burr_frame(spindle_axis);
    for (const Sample& sample : samples_) {
        const glm::dvec3 arm_mm = frame * sample.arm_mm;
        const glm::dvec3 at = to_voxel_coordinates(bone.grid(), position_mm + arm_mm);
        if (!bricks_.gather(bone, at, Engagement::reach_voxels)) continue;
        const glm::dvec3 normal = frame * sample.normal;
        // No deeper than the spindle: beyond it lies the bone of the other side.
        const double inmost = std::max(-Engagement::reach_voxels, -sample.radius_mm / h);
        const std::optional<float> gap = gap_voxels(bricks_, glm::vec3(at - glm::dvec3(bricks_.base())),
                                                    glm::vec3(normal), static_cast<float>(inmost));
        if (!gap) continue;
        out.shank_patches[out.shank_count++] = {.normal = normal,
                                                .gap_mm = static_cast<double>(*gap) * h,
                                                .area_mm2 = sample.area_mm2,
                                                .arm_mm = arm_mm};
    }
}

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
