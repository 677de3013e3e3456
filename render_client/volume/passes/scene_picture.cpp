#include "render_client/volume/passes/scene_picture.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace osteomill {

ScenePicture::ScenePicture(BoneRenderer& renderer, const glm::ivec2& size_px, Stopwatch* stopwatch,
                           double frame_s)
    : layer_(renderer, glm::max(size_px, 1), stopwatch, frame_s),
      picture_(layer_.size_px()),
      covered_(layer_.size_px()) {}

void ScenePicture::resize(const glm::ivec2& size_px) {
    const glm::ivec2 size = glm::max(size_px, 1);
    if (size == picture_.size_px()) return;
    layer_.resize(size);
    picture_ = gl::Framebuffer(size);
    covered_ = TileMask(size);
}

const gl::Framebuffer& ScenePicture::draw(const BoneTextures* bone, const DrawnTool* tool,
                                          const Camera& camera) {
    if (bone) {
        covered_ |= layer_.update(*bone, camera);
        for (const PixelBox& box : covered_.rectangles()) layer_.framebuffer().copy_to(picture_, box);
        covered_.clear();
    }
    picture_.bind();
    if (!bone) {
        const glm::vec3 grey = glm::pow(layer_.look().background_low, glm::vec3(1.0f / 2.2f));
        glClearColor(grey.r, grey.g, grey.b, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        covered_.mark_all();
    }
    if (bone && tool) {
        contact_shadow_.draw(layer_.framebuffer(), tool->state.burr_position_mm, 0.5 * tool->burr.diameter_mm,
                             tool->state.spindle_axis, camera, covered_);
        tool_renderer_.draw(*tool, camera, covered_);
    }
    if (bone) structures_.draw(camera, layer_.look(), covered_);
    if (bone && tool) {
        tool_renderer_.draw_seen_through(*tool, camera, picture_.size_px());
        tool_renderer_.draw_force(*tool, camera, covered_);
    }
    if (bone && layer_.look().light_field) {
        if (!light_field_) light_field_.emplace();
        light_field_->draw(layer_.framebuffer(), camera);
        covered_.mark_all();
    }
    return picture_;
}

void ScenePicture::cover(std::span<const PixelBox> boxes) {
    for (const PixelBox& box : boxes) covered_.mark(box);
}

}  // namespace osteomill
