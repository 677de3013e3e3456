#include "render_client/volume/passes/contact_shadow.h"

#include "render_client/volume/camera.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

constexpr double reach_radii = 6.0;  // as in contact_shadow.frag.glsl
constexpr int depth_unit = 1;        // behind the colour

}  // namespace

ContactShadow::ContactShadow() : program_(make_program(contact_shadow_files)) {}

void ContactShadow::draw(const gl::Framebuffer& bone, const glm::dvec3& burr_mm, double radius_mm,
                         const glm::dvec3& spindle_axis, const Camera& camera, TileMask& covered) const {
    const glm::ivec2& size_px = covered.size_px();
    const glm::dvec2 half_extent = camera.half_extent(size_px);
    const glm::dmat4 projection = camera.projection(size_px);
    program_.use();
    program_.set("bone_depth", depth_unit);
    program_.set("middle_ray", glm::vec3(camera.middle_ray()));
    program_.set("right", glm::vec3(half_extent.x * camera.right()));
    program_.set("up", glm::vec3(half_extent.y * camera.up()));
    program_.set("eye", glm::vec3((camera.eye_mm() - burr_mm) / radius_mm));
    program_.set("spindle_axis", glm::vec3(spindle_axis));
    program_.set("picture_size", glm::vec2(size_px));
    program_.set("depth_terms", glm::vec2(0.5 - 0.5 * projection[2][2], 0.5 * projection[3][2] / radius_mm));
    bone.bind_textures(depth_unit - 1);

    const double reach_mm = reach_radii * radius_mm;
    const auto pixels = pixels_of_box(camera, burr_mm - reach_mm, burr_mm + reach_mm, size_px);
    if (pixels) {
        covered.mark(*pixels);
        glEnable(GL_SCISSOR_TEST);
        glScissor(pixels->first.x, pixels->first.y, pixels->size.x, pixels->size.y);
    } else {
        covered.mark_all();
    }
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    program_.fill_picture();
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace osteomill
