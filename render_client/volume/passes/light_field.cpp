#include "render_client/volume/passes/light_field.h"

#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

LightField::LightField() : program_(make_program(light_field_files)) {}

void LightField::draw(const gl::Framebuffer& bone, const Camera& camera) const {
    constexpr int colour_unit = 0, bone_depth_unit = 1;
    const glm::dmat4 projection = camera.projection(bone.size_px());
    program_.use();
    program_.set("bone_depth", bone_depth_unit);
    program_.set("picture_size", glm::vec2(bone.size_px()));
    program_.set("pixel_aspect", static_cast<float>(camera.pixel_aspect));
    program_.set("depth_terms", glm::vec2(0.5 - 0.5 * projection[2][2], 0.5 * projection[3][2]));
    program_.set("focus", static_cast<float>(camera.distance_mm));
    bone.bind_textures(colour_unit);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    program_.fill_picture();
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
}

}  // namespace osteomill
