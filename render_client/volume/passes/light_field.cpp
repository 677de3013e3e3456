#include "render_client/volume/passes/light_field.h"

#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

LightField::LightField() : program_(make_program(light_field_files)) {}

void LightField::draw(const glm::ivec2& size_px, double pixel_aspect) const {
    program_.use();
    program_.set("picture_size", glm::vec2(size_px));
    program_.set("pixel_aspect", static_cast<float>(pixel_aspect));
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    program_.fill_picture();
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
}

}  // namespace osteomill
