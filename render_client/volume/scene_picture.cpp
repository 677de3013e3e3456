#include "render_client/volume/scene_picture.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// How far from a voxel the shading of a surface can depend on it: ambient occlusion looks 16 voxels away
/// into a map of 4-voxel blocks that is interpolated.
constexpr int shading_reach_voxels = 24;

}  // namespace

ScenePicture::ScenePicture(BoneRenderer& renderer, const glm::ivec2& size_px)
    : renderer_(renderer), layer_(glm::max(size_px, 1)), picture_(glm::max(size_px, 1)) {}

void ScenePicture::resize(const glm::ivec2& size_px) {
    const glm::ivec2 size = glm::max(size_px, 1);
    if (size == layer_.size_px()) return;
    layer_ = gl::Framebuffer(size);
    picture_ = gl::Framebuffer(size);
    layer_camera_.reset();
}

void ScenePicture::set_look(const SceneLook& look) {
    if (look == renderer_.look()) return;
    renderer_.set_look(look);
    layer_camera_.reset();
}

void ScenePicture::forget_bone() {
    layer_camera_.reset();
    dirty_.clear();
}

void ScenePicture::mark_dirty(const BoneTextures& bone, std::span<const BrickIndex> bricks) {
    const glm::ivec3 size_bricks = size_in_bricks(bone.grid());
    for (const BrickIndex brick : bricks)
        dirty_.push_back(
            {brick_position(size_bricks, brick) * brick_edge_voxels, glm::ivec3(brick_edge_voxels)});
}

const gl::Framebuffer& ScenePicture::draw(const BoneTextures* bone, const DrawnTool* tool,
                                          const Camera& camera) {
    if (bone) {
        draw_layer(*bone, camera);
        layer_.copy_to(picture_);
    }
    picture_.bind();
    if (!bone) {
        const glm::vec3 grey = glm::pow(renderer_.look().background_low, glm::vec3(1.0f / 2.2f));
        glClearColor(grey.r, grey.g, grey.b, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    if (bone && tool) {
        contact_shadow_.draw(layer_, tool->position_mm, 0.5 * tool->burr.diameter_mm, tool->spindle_axis,
                             camera, size_px());
        tool_renderer_.draw(*tool, camera, size_px());
    }
    return picture_;
}

void ScenePicture::draw_layer(const BoneTextures& bone, const Camera& camera) {
    layer_.bind();
    if (layer_camera_ != camera) {
        renderer_.draw(bone, camera, size_px());
        layer_camera_ = camera;
        dirty_.clear();
        return;
    }
    if (dirty_.empty()) return;
    glm::ivec3 low = dirty_.front().first, high = low;
    for (const VoxelBox& box : dirty_) {
        low = glm::min(low, box.first);
        high = glm::max(high, box.first + box.size);
    }
    dirty_.clear();
    const auto pixels =
        pixels_of_box(camera, centre_of_voxel_mm(bone.grid(), low - shading_reach_voxels),
                      centre_of_voxel_mm(bone.grid(), high + shading_reach_voxels), size_px());
    if (pixels) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(pixels->first.x, pixels->first.y, pixels->size.x, pixels->size.y);
    }
    renderer_.draw(bone, camera, size_px());
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace osteomill
