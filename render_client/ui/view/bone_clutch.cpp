#include "render_client/ui/view/bone_clutch.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace osteomill {

namespace {

glm::dmat3 axes_of(const Camera& camera) {
    return {camera.right(), camera.up(), -camera.forward()};
}

}  // namespace

ToolPose BoneClutch::pose(const Camera& camera) const {
    if (camera == held_->camera) return held_->tool;
    const glm::dmat3 turn = axes_of(camera) * glm::transpose(axes_of(held_->camera));
    return {camera.eye_mm() + turn * (held_->tool.position_mm - held_->camera.eye_mm()),
            glm::normalize(turn * held_->tool.spindle_axis)};
}

}  // namespace osteomill
