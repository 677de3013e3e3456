#include "render_client/volume/scene_picture.h"

#include <algorithm>
#include <glm/common.hpp>
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

void ScenePicture::forget_bone() {
    layer_camera_.reset();
    dirty_.clear();
}

void ScenePicture::mark_dirty(const BoneTextures& bone, std::span<const BrickIndex> bricks) {
    for (const BrickIndex brick : bricks) dirty_.push_back(bone.voxels_of_brick(brick));
}

const gl::Framebuffer& ScenePicture::draw(const BoneTextures* bone, const DrawnTool* tool,
                                          const Camera& camera) {
    if (bone) {
        draw_layer(*bone, camera);
        layer_.copy_to(picture_);
    }
    picture_.bind();
    if (!bone) {
        glClearColor(0.22f, 0.23f, 0.25f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    if (bone && tool) tool_renderer_.draw(*tool, camera, size_px());
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

std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px) {
    glm::dvec2 first(size_px), last(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place(corner & 1 ? high_mm.x : low_mm.x, corner & 2 ? high_mm.y : low_mm.y,
                               corner & 4 ? high_mm.z : low_mm.z);
        if (glm::dot(place - camera.eye_mm(), camera.forward()) < camera.near_mm) return std::nullopt;
        const glm::dvec2 pixel = pixel_of(camera, place, size_px);
        first = glm::min(first, pixel);
        last = glm::max(last, pixel);
    }
    const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor(first)) - 1, glm::ivec2(0), size_px);
    const glm::ivec2 high = glm::clamp(glm::ivec2(glm::ceil(last)) + 1, glm::ivec2(0), size_px);
    const glm::ivec2 size = glm::max(high - low, 0);
    // pixel_of counts rows from the top.
    return PixelBox{{low.x, size_px.y - low.y - size.y}, size};
}

}  // namespace osteomill
