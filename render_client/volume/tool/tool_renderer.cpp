#include "render_client/volume/tool/tool_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "render_client/volume/bone_colours.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

/// Rotation that takes +z to `axis`.
glm::dmat4 z_to(const glm::dvec3& axis) {
    const glm::dvec3 z = glm::normalize(axis);
    const glm::dvec3 helper = std::abs(z.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 y = glm::normalize(glm::cross(z, helper));
    const glm::dvec3 x = glm::cross(y, z);
    return {glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0)};
}

}  // namespace

ToolRenderer::ToolRenderer()
    : program_(make_program(tool_files)),
      // Orange and sky blue of Okabe and Ito's palette: told apart by every kind of colour vision.
      arrow_(unit_arrow(linear_from_srgb({230, 159, 0}))),
      ghost_(unit_sphere(linear_from_srgb({86, 180, 233}))),
      burr_(burr_and_shank(burr_shape_)) {}

void ToolRenderer::draw(const DrawnTool& tool, const Camera& camera, TileMask& covered) {
    if (tool.burr != burr_shape_) {
        burr_shape_ = tool.burr;
        burr_ = gl::Mesh(burr_and_shank(burr_shape_));
    }
    const glm::dmat4 view_projection = camera.projection(covered.size_px()) * camera.view();
    program_.use();
    program_.set("eye", glm::vec3(camera.eye_mm()));
    const glm::dmat4 at_burr =
        glm::translate(glm::dmat4(1.0), tool.state.burr_position_mm) * z_to(tool.state.spindle_axis);
    glEnable(GL_DEPTH_TEST);
    draw_mesh(burr_, glm::rotate(at_burr, tool.spin_rad, glm::dvec3(0, 0, 1)), view_projection,
              {.polish = 1.0f}, covered);

    const double force_n = glm::length(tool.state.force_n);
    if (std::isfinite(force_n) && force_n > shortest_arrow_n) {
        const double length_mm = arrow_mm_per_n * force_n;
        const glm::dmat4 at_force =
            glm::translate(glm::dmat4(1.0), tool.state.burr_position_mm) * z_to(tool.state.force_n);
        // The arrow starts within the burr and may end in bone: it is information, not a thing, so it is
        // always seen. Back faces must not show through it.
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        const double thickness_mm = std::min(length_mm, 10.0);
        draw_mesh(arrow_, glm::scale(at_force, glm::dvec3(thickness_mm, thickness_mm, length_mm)),
                  view_projection, {}, covered);
        glDisable(GL_CULL_FACE);
        glEnable(GL_DEPTH_TEST);
    }
    if (tool.hand_target_mm) {
        const glm::dmat4 at_hand = glm::translate(glm::dmat4(1.0), *tool.hand_target_mm);
        glEnable(GL_BLEND);
        glEnable(GL_CULL_FACE);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glDisable(GL_DEPTH_TEST);
        draw_mesh(ghost_, glm::scale(at_hand, glm::dvec3(0.5 * tool.burr.diameter_mm)), view_projection,
                  {.opacity = 0.25f}, covered);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
    }
}

void ToolRenderer::draw_mesh(const gl::Mesh& mesh, const glm::dmat4& model, const glm::dmat4& view_projection,
                             const Finish& finish, TileMask& covered) const {
    mark_box(covered, mesh.low(), mesh.high(), view_projection * model);
    program_.set("to_clip", glm::mat4(view_projection * model));
    program_.set("to_patient", glm::mat4(model));
    program_.set("normal_to_patient", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(model)))));
    program_.set("opacity", finish.opacity);
    program_.set("polish", finish.polish);
    mesh.draw();
}

}  // namespace osteomill
