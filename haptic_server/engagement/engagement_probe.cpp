#include "haptic_server/engagement/engagement_probe.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/scene/burr_frame.h"
#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

/// Where along a patch's normal the bone is looked at, from the burr's surface.
constexpr std::array<float, 4> offsets_voxels{-static_cast<float>(Engagement::reach_voxels), -0.5f, 0.5f,
                                              static_cast<float>(Engagement::reach_voxels)};
/// Half of a voxel's 255 levels: the bone's surface.
constexpr float half = 127.5f;

using Floats [[gnu::vector_size(16)]] = float;
using Ints [[gnu::vector_size(16)]] = std::int32_t;

/// Fractions, 0 to 255, at `offset` from the surface of four patches.
Floats fractions(const BrickNeighbourhood& bricks, const std::array<Floats, 3>& surface,
                 const std::array<Floats, 3>& outward, float offset) {
    std::array<Floats, 3> position;
    std::array<Ints, 3> voxel;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis] = surface[axis] + offset * outward[axis];
        voxel[axis] = __builtin_convertvector(position[axis], Ints);
        position[axis] -= __builtin_convertvector(voxel[axis], Floats);
    }
    const Ints brick = (voxel[0] >> 4) + bricks.edge() * ((voxel[1] >> 4) + bricks.edge() * (voxel[2] >> 4));
    const Ints in_brick = (voxel[0] & 15) | (voxel[1] & 15) << 4 | (voxel[2] & 15) << 8;
    const Ints is_last = ((voxel[0] & 15) == 15) | ((voxel[1] & 15) == 15) | ((voxel[2] & 15) == 15);
    // The low and the high four corners of each.
    Ints low{};
    Ints high{};
    bool any = false;
    for (int lane = 0; lane < 4; ++lane) {
        const std::uint64_t corners = is_last[lane] != 0
                                          ? bricks.corners({voxel[0][lane], voxel[1][lane], voxel[2][lane]})
                                          : bricks.corners_within(brick[lane], in_brick[lane]);
        low[lane] = static_cast<std::int32_t>(corners & 0xffffffffu);
        high[lane] = static_cast<std::int32_t>(corners >> 32);
        any |= corners != 0;
    }
    if (!any) return Floats{};
    std::array<Floats, 8> c;
    for (int corner = 0; corner < 4; ++corner) {
        c[static_cast<std::size_t>(corner)] = __builtin_convertvector(low >> (8 * corner) & 255, Floats);
        c[static_cast<std::size_t>(corner) + 4] = __builtin_convertvector(high >> (8 * corner) & 255, Floats);
    }
    return detail::trilinear(c, position[0], position[1], position[2]);
}

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
      bricks_(bounding_radius_mm_ / spacing_mm + Engagement::reach_voxels + 2.0),
      shank_(burr) {
    if (!burr.is_ball()) {
        const BurrProfile head(burr.head, burr.diameter_mm);
        middle_height_mm_ = 0.5 * (head.tip_height() + head.top_height());
        has_beside_ = true;
    }
    const std::size_t count = patches_.size();
    // Filled up to whole fours with the last one.
    const std::size_t padded = (count + four - 1) / four * four;
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < padded; ++i) {
            const BurrPatch& patch = patches_[std::min(i, count - 1)];
            const auto at = static_cast<std::size_t>(axis);
            normals_[at].push_back(static_cast<float>(patch.normal[axis]));
            if (has_beside_) beside_[at].push_back(static_cast<float>(patch.beside_mm[axis] / spacing_mm));
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
    for (std::size_t first = 0; first < patches_.size(); first += four) {
        const FourFractions along =
            sample_four(first, glm::mat3(frame), centre_in_bricks, radius_voxels, inside);
        for (std::size_t lane = 0; lane < four && first + lane < patches_.size(); ++lane) {
            const Crossing crossing = first_crossing(along, lane);
            if (!crossing.found) continue;
            const BurrPatch& patch = patches_[first + lane];
            const glm::dvec3 normal = frame * patch.normal;
            const glm::vec3 outward(normal);
            glm::vec3 surface = centre_in_bricks + radius_voxels * outward;
            if (has_beside_) surface += glm::vec3(frame * patch.beside_mm / h);
            // Stiffness one voxel into the bone, where no partial voxel dilutes it.
            double stiffness = bricks_.stiffness(surface + (crossing.offset_voxels + 1.0f) * outward);
            if (stiffness == 0.0)
                stiffness = bricks_.stiffness(surface + crossing.bone_offset_voxels * outward);
            EngagedPatch& engaged = out.patches[out.count++];
            engaged = {.normal = normal,
                       .gap_mm = static_cast<double>(crossing.offset_voxels) * h,
                       .cutting_n_s_per_mm = stiffness / speed_share * (frame * patch.cutting_n_s_per_mm),
                       .area_mm2 = patch.area_mm2};
            if (uncut_.has_any && is_uncut(surface, outward, crossing)) {
                engaged.is_wall = out.has_walls = true;
                engaged.cutting_n_s_per_mm = glm::dvec3(0.0);
            } else if (has_edge_force_) {
                const std::uint8_t label =
                    bricks_.tissue(surface + (crossing.offset_voxels + 1.0f) * outward);
                engaged.edge_n =
                    stiffness * static_cast<double>(edge_shares_.of_label[label]) * (frame * patch.edge_n);
            }
        }
    }
}

bool EngagementProbe::is_uncut(const glm::vec3& surface, const glm::vec3& outward,
                               const Crossing& crossing) const noexcept {
    // Where bone begins, rather than behind: a layer on top of it is still to be cut.
    return uncut_.of_label[bricks_.tissue(surface + (crossing.offset_voxels + 0.5f) * outward)];
}

EngagementProbe::FourFractions EngagementProbe::sample_four(std::size_t first, const glm::mat3& frame,
                                                            const glm::vec3& centre, float radius_voxels,
                                                            InsideBurr inside) const noexcept {
    std::array<Floats, 3> normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
        std::memcpy(&normal[axis], &normals_[axis][first], sizeof normal[axis]);
    std::array<Floats, 3> outward;
    std::array<Floats, 3> surface;
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        outward[at] = frame[0][axis] * normal[0] + frame[1][axis] * normal[1] + frame[2][axis] * normal[2];
        surface[at] = centre[axis] + radius_voxels * outward[at];
        if (!has_beside_) continue;
        std::array<Floats, 3> beside;
        for (std::size_t i = 0; i < 3; ++i) std::memcpy(&beside[i], &beside_[i][first], sizeof beside[i]);
        surface[at] += frame[0][axis] * beside[0] + frame[1][axis] * beside[1] + frame[2][axis] * beside[2];
    }
    FourFractions along{};
    const auto look = [&](std::size_t i) {
        const Floats fraction = fractions(bricks_, surface, outward, offsets_voxels[i]);
        std::memcpy(along[i].data(), &fraction, sizeof fraction);
        const auto is_bone = [](float lane) { return lane >= half; };
        return static_cast<int>(std::count_if(along[i].begin(), along[i].end(), is_bone));
    };
    if (inside == InsideBurr::carved) {
        const int in_bone = look(2);
        if (in_bone > 0) look(1);
        if (in_bone < 4) look(3);
        return along;
    }
    for (std::size_t i = 0; i < offsets_voxels.size(); ++i)
        if (look(i) == 4) break;
    return along;
}

EngagementProbe::Crossing EngagementProbe::first_crossing(const FourFractions& along, std::size_t lane) {
    for (std::size_t i = 0; i < offsets_voxels.size(); ++i) {
        const float fraction = along[i][lane];
        if (fraction < half) continue;
        const float offset = offsets_voxels[i];
        if (i == 0) return {true, offset, offset};
        const float inner = along[i - 1][lane];
        const float inner_offset = offsets_voxels[i - 1];
        return {true, inner_offset + (offset - inner_offset) * (half - inner) / (fraction - inner), offset};
    }
    return {};
}

}  // namespace osteomill
