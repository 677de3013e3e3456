#include "render_client/dataset/first_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <variant>

#include "render_client/volume/surface_points.h"

namespace osteomill {

namespace {

/// A bone that is no larger is shown whole.
constexpr double closest_mm = 10.0;
/// Shown about tool and target, in their own size.
constexpr double surroundings = 3.0;
/// The least part of the bone's radius that is shown: a smaller part of a vault looks like a wall.
constexpr double least_part = 0.25;
constexpr double least_part_without_target = 0.45;

/// Between the handpiece and the way to the eye: first so that both stand out, then for a burr in a hollow.
constexpr std::array angles_rad{0.9, 0.6, 0.3, 0.05};

void look_from(Camera& camera, const glm::dvec3& to_eye) {
    look_along(camera, -to_eye);
    orbit(camera, 0.0, 0.0);  // no nearer to straight up or down than it may
}

/// Unit: `to_eye`, or, if it is more than `angle_rad` from `axis`, the direction at that angle in their
/// plane.
glm::dvec3 turned_towards(const glm::dvec3& axis, const glm::dvec3& to_eye, double angle_rad) {
    const double along = glm::dot(to_eye, axis);
    if (along >= std::cos(angle_rad)) return to_eye;
    const glm::dvec3 aside = to_eye - along * axis;
    const double length = glm::length(aside);
    if (length < 1e-6) return axis;
    return std::cos(angle_rad) * axis + std::sin(angle_rad) / length * aside;
}

bool is_seen(const Bone& bone, const Camera& camera, const BallInView& burr) {
    constexpr glm::ivec2 size_px(1000, 1000);
    const auto hit = pick_surface(bone, camera, pixel_of(camera, burr.centre_mm, size_px), size_px, {});
    return !hit || glm::distance(hit->position_mm, camera.eye_mm()) >=
                       glm::distance(burr.centre_mm, camera.eye_mm()) - burr.radius_mm;
}

BallInView round_box(const glm::dvec3& low_mm, const glm::dvec3& high_mm) {
    return {0.5 * (low_mm + high_mm), 0.5 * glm::distance(low_mm, high_mm)};
}

std::optional<BallInView> tissue_in_view(const Bone& bone, std::uint8_t label) {
    const BoneContent& content = bone.content();
    glm::ivec3 low(std::numeric_limits<int>::max());
    glm::ivec3 high(std::numeric_limits<int>::lowest());
    for (std::size_t slot = 0; slot < content.tissue.size(); ++slot) {
        const ByteBrick& labels = content.tissue[slot];
        if (std::ranges::find(labels, label) == labels.end()) continue;
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            if (labels[offset] != label) continue;
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            low = glm::min(low, voxel);
            high = glm::max(high, voxel);
        }
    }
    if (low.x > high.x) return std::nullopt;
    return round_box(centre_of_voxel_mm(bone.grid(), low), centre_of_voxel_mm(bone.grid(), high));
}

}  // namespace

BallInView round_both(const BallInView& a, const BallInView& b) {
    const double distance_mm = glm::distance(a.centre_mm, b.centre_mm);
    if (distance_mm + b.radius_mm <= a.radius_mm) return a;
    if (distance_mm + a.radius_mm <= b.radius_mm) return b;
    const double radius_mm = 0.5 * (distance_mm + a.radius_mm + b.radius_mm);
    return {a.centre_mm + (radius_mm - a.radius_mm) / distance_mm * (b.centre_mm - a.centre_mm), radius_mm};
}

std::optional<BallInView> target_in_view(const Bone& bone, const SessionInfo& session) {
    if (!session.plan) return std::nullopt;
    if (const auto* sphere = std::get_if<SphereRegion>(&session.plan->region))
        return BallInView{sphere->centre_mm, sphere->radius_mm};
    if (const auto* cylinder = std::get_if<CylinderRegion>(&session.plan->region))
        return BallInView{
            0.5 * (cylinder->from_mm + cylinder->to_mm),
            std::hypot(0.5 * glm::distance(cylinder->from_mm, cylinder->to_mm), cylinder->radius_mm)};
    const auto& name = std::get<TissueRegion>(session.plan->region).tissue;
    const auto tissue = std::ranges::find(session.tissues, name, &Tissue::name);
    return tissue != session.tissues.end() ? tissue_in_view(bone, tissue->label) : std::nullopt;
}

Camera first_view(const Bone& bone, const BallInView& all, const std::optional<ToolPose>& tool,
                  double burr_radius_mm, const std::optional<BallInView>& target) {
    Camera camera = camera_on(all.centre_mm, all.radius_mm);
    if (!tool) return camera;
    BallInView burr{tool->position_mm, burr_radius_mm};
    const glm::dvec3 from_middle_mm = burr.centre_mm - all.centre_mm;
    const double away_mm = glm::length(from_middle_mm);
    if (away_mm > all.radius_mm) burr.centre_mm = all.centre_mm + all.radius_mm / away_mm * from_middle_mm;

    BallInView shown = target ? round_both(burr, *target) : burr;
    shown.radius_mm = std::max({surroundings * shown.radius_mm, closest_mm,
                                (target ? least_part : least_part_without_target) * all.radius_mm});
    if (shown.radius_mm < all.radius_mm) {
        camera.target_mm = shown.centre_mm;
        zoom(camera, shown.radius_mm / all.radius_mm);
    }
    const glm::dvec3 from_front = -camera.forward();
    for (const double angle_rad : angles_rad) {
        look_from(camera, turned_towards(tool->spindle_axis, from_front, angle_rad));
        if (is_seen(bone, camera, burr)) break;
    }
    return camera;
}

Camera first_view(const Bone& bone, const BoneTextures& textures, const SessionInfo* session,
                  const ToolState* tool) {
    std::optional<ToolPose> pose;
    if (tool) pose = ToolPose{tool->burr_position_mm, tool->spindle_axis};
    const Burr* burr = tool && session ? session->burr_of(tool->burr) : nullptr;
    return first_view(bone, ball_round(textures), pose, burr ? burr->radius_mm() : 0.0,
                      session ? target_in_view(bone, *session) : std::nullopt);
}

BallInView ball_round(const BoneTextures& textures) {
    const VoxelBox& box = textures.box();
    const Grid& grid = textures.grid();
    const glm::dvec3 middle_mm =
        0.5 * (centre_of_voxel_mm(grid, box.first) + centre_of_voxel_mm(grid, box.first + box.size - 1));
    return {middle_mm, glm::length(0.5 * grid.spacing_mm * glm::dvec3(box.size))};
}

}  // namespace osteomill
