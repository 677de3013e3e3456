#include "haptic_server/session/tool_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "simulation/force_models/ball_rows.h"

namespace osteomill {

namespace {

constexpr double step_mm = 0.1;

bool is_clear(const Bone& bone, const std::vector<HullBall>& hull, const ToolPose& pose, double gap_mm) {
    const Grid& grid = bone.grid();
    return std::ranges::none_of(hull, [&](const HullBall& ball) {
        const glm::dvec3 centre_mm = pose.position_mm + ball.height_mm * pose.spindle_axis;
        return has_bone_in(
            bone, {to_voxel_coordinates(grid, centre_mm), (ball.radius_mm + gap_mm) / grid.spacing_mm});
    });
}

/// The first place that is clear, with the least gap, on the way back along the handpiece.
std::optional<ToolPose> drawn_back(const Bone& bone, const std::vector<HullBall>& hull, ToolPose pose,
                                   double longest_mm) {
    const glm::dvec3 from_mm = pose.position_mm;
    for (double back_mm = 0.0; back_mm <= longest_mm; back_mm += step_mm) {
        pose.position_mm = from_mm + back_mm * pose.spindle_axis;
        if (is_clear(bone, hull, pose, least_gap_mm)) return pose;
    }
    return std::nullopt;
}

/// From a point to the box of the bricks that hold bone.
double distance_to_bricks_mm(const Bone& bone, const glm::dvec3& position_mm) {
    const BoneContent& content = bone.content();
    glm::ivec3 low(std::numeric_limits<int>::max());
    glm::ivec3 high(std::numeric_limits<int>::lowest());
    for (const BrickIndex index : content.brick_of_slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, index);
        low = glm::min(low, brick);
        high = glm::max(high, brick);
    }
    if (content.brick_of_slot.empty()) return std::numeric_limits<double>::infinity();
    const glm::dvec3 at = to_voxel_coordinates(content.grid, position_mm) / double{brick_edge_voxels};
    const glm::dvec3 nearest = glm::clamp(at, glm::dvec3(low), glm::dvec3(high + 1));
    return glm::distance(at, nearest) * brick_edge_voxels * content.grid.spacing_mm;
}

}  // namespace

std::variant<ToolPose, std::string> clear_place(const Bone& bone, const std::vector<HullBall>& hull,
                                                const ToolPose& wanted) {
    const double away_mm = distance_to_bricks_mm(bone, wanted.position_mm);
    if (away_mm > farthest_from_bone_mm)
        return fmt::format("that is {:.0f} mm away from the bone; choose a place within {:.0f} mm of it",
                           away_mm, farthest_from_bone_mm);
    if (const auto clear = drawn_back(bone, hull, wanted, longest_draw_back_mm)) return *clear;
    return fmt::format("that is inside the bone, and so is all within {:.0f} mm along the handpiece",
                       longest_draw_back_mm);
}

std::optional<ToolPose> lifted_out(const Bone& bone, const std::vector<HullBall>& hull, const ToolPose& at) {
    if (is_clear(bone, hull, at, 0.0)) return std::nullopt;
    return drawn_back(bone, hull, at, longest_lift_mm);
}

}  // namespace osteomill
