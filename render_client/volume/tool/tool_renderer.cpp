#include "render_client/volume/tool/tool_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
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

// Values of sees_through in tool.frag.glsl.
constexpr float leave_out = 1.0f;
constexpr float leave_only = 2.0f;

/// The part of the screen that the shank must not hide: the burr and its surroundings.
struct HiddenField {
    bool is_before_eye = false;
    glm::dvec2 middle_px{0.0};  ///< y up
    double radius_px = 1.0;
    double radius_mm = 1.0;
};

/// From afar the burr alone would be too small a hole to look through.
constexpr double least_radius_px = 8.0;
constexpr double edge_radii = 2.5;  // as in tool.frag.glsl

HiddenField field_of(const DrawnTool& tool, const Camera& camera, const glm::ivec2& size_px) {
    const glm::dvec3& burr_mm = tool.state.burr_position_mm;
    if (tool.is_only_a_thing || !camera.has_in_front(burr_mm)) return {};
    const double mm_per_px = mm_per_px_at(camera, burr_mm, size_px);
    const double radius_px = std::max(0.5 * tool.burr.diameter_mm / mm_per_px, least_radius_px);
    const glm::dvec2 down = pixel_of(camera, burr_mm, size_px);
    return {true, {down.x, size_px.y - down.y}, radius_px, radius_px * mm_per_px};
}

/// The pose of what does not turn with the burr.
glm::dmat4 pose_of_handpiece(const DrawnTool& tool) {
    return glm::translate(glm::dmat4(1.0), tool.state.burr_position_mm) * z_to(tool.state.spindle_axis);
}

/// Draws a translucent mesh over the picture so far: first the depth of its nearest surface, then its colour,
/// so that only one of its surfaces is seen.
void draw_translucent(const gl::Mesh& mesh) {
    glEnable(GL_CULL_FACE);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    mesh.draw();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    mesh.draw();
    glDisable(GL_BLEND);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
}

}  // namespace

glm::dmat4 pose_of(const DrawnTool& tool) {
    return glm::rotate(pose_of_handpiece(tool), tool.spin_rad, glm::dvec3(0, 0, 1));
}

double handpiece_opacity(const DrawnTool& tool, const Camera& camera) {
    constexpr double solid_cosine = 0.5, gone_cosine = 0.866;
    if (!tool.has_handpiece) return 0.0;
    const glm::dvec3 to_eye = camera.eye_mm() - tool.state.burr_position_mm;
    const double cosine = glm::dot(glm::normalize(to_eye), glm::normalize(tool.state.spindle_axis));
    return 1.0 - glm::smoothstep(solid_cosine, gone_cosine, cosine);
}

std::optional<ForceArrow> force_arrow(const ToolState& tool, double burr_radius_mm, const Camera& camera,
                                      const glm::ivec2& size_px) {
    constexpr double mm_per_n = 4.0, shortest_px = 40.0, least_force_n = 0.02;
    const double force_n = glm::length(tool.force_n);
    const glm::dvec3& burr_mm = tool.burr_position_mm;
    if (!std::isfinite(force_n) || force_n < least_force_n || !camera.has_in_front(burr_mm))
        return std::nullopt;
    const glm::dvec3 along = tool.force_n / force_n;
    // Seen from its end it would have to be endless.
    constexpr double least_part_across = 0.25;
    const double part_across = std::max(glm::length(glm::cross(along, camera.forward())), least_part_across);
    const double length_mm =
        std::max(mm_per_n * force_n, shortest_px * mm_per_px_at(camera, burr_mm, size_px) / part_across);
    const glm::dvec3 from_mm = burr_mm + burr_radius_mm * along;
    return ForceArrow{from_mm, from_mm + length_mm * along};
}

ToolRenderer::ToolRenderer()
    : program_(make_program(tool_files)),
      // Orange and sky blue of Okabe and Ito's palette: told apart by every kind of colour vision.
      arrow_(unit_arrow(linear_from_srgb({230, 159, 0}))),
      arrow_outline_(unit_arrow(glm::vec3(0.0f))),
      ghost_(unit_sphere(linear_from_srgb({86, 180, 233}))),
      head_(burr_head(burr_shape_)),
      shank_(burr_shank(burr_shape_)),
      handpiece_(handpiece(burr_shape_)) {}

void ToolRenderer::shape(const DrawnTool& tool) {
    if (tool.burr == burr_shape_ && tool.motion == burr_motion_) return;
    if (tool.burr != burr_shape_) handpiece_ = gl::Mesh(handpiece(tool.burr));
    burr_shape_ = tool.burr;
    burr_motion_ = tool.motion;
    head_ = gl::Mesh(burr_head(burr_shape_, burr_motion_));
    shank_ = gl::Mesh(burr_shank(burr_shape_, burr_motion_));
}

void ToolRenderer::draw(const DrawnTool& tool, const Camera& camera, TileMask& covered) {
    shape(tool);
    const glm::dmat4 view_projection = camera.projection(covered.size_px()) * camera.view();
    program_.use();
    program_.set("eye", glm::vec3(camera.eye_mm()));
    const HiddenField field = field_of(tool, camera, covered.size_px());
    program_.set("field_middle_px", glm::vec2(field.middle_px));
    program_.set("field_radius_px", static_cast<float>(field.radius_px));
    program_.set("field_radius_mm", static_cast<float>(field.radius_mm));
    program_.set("burr_centre", glm::vec3(tool.state.burr_position_mm));
    program_.set("forward", glm::vec3(camera.forward()));
    const glm::dmat4 at_burr = pose_of(tool);
    glEnable(GL_DEPTH_TEST);
    draw_mesh(head_, at_burr, view_projection, {.polish = 1.0f}, covered);
    // The part left out must not show the inside of the shank.
    glEnable(GL_CULL_FACE);
    draw_mesh(shank_, at_burr, view_projection,
              {.polish = 1.0f, .sees_through = field.is_before_eye ? leave_out : 0.0f}, covered);
    if (const double opacity = handpiece_opacity(tool, camera); opacity >= 1.0)
        draw_mesh(handpiece_, pose_of_handpiece(tool), view_projection, {.polish = 1.0f}, covered);
    else if (opacity > 0.0)
        mark_box(covered, handpiece_.low(), handpiece_.high(), view_projection * pose_of_handpiece(tool));
    glDisable(GL_CULL_FACE);

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

void ToolRenderer::draw_force(const DrawnTool& tool, const Camera& camera, TileMask& covered) const {
    if (tool.is_only_a_thing) return;
    const auto arrow = force_arrow(tool.state, 0.5 * tool.burr.diameter_mm, camera, covered.size_px());
    if (!arrow) return;
    constexpr double thickest_mm = 10.0, thinnest_px = 70.0, outline_px = 1.5;
    constexpr double shaft_radius = 0.03;  // of unit_arrow
    const double mm_per_px = mm_per_px_at(camera, arrow->from_mm, covered.size_px());
    const double length_mm = glm::distance(arrow->from_mm, arrow->head_mm);
    const double thickness_mm = std::max(std::min(length_mm, thickest_mm), thinnest_px * mm_per_px);
    const double outline_mm = outline_px * mm_per_px;
    const glm::dvec3 along = (arrow->head_mm - arrow->from_mm) / length_mm;
    const auto placed = [&](double grown_mm) {
        const double thick_mm = thickness_mm + grown_mm / shaft_radius;
        return glm::scale(
            glm::translate(glm::dmat4(1.0), arrow->from_mm - grown_mm * along) * z_to(tool.state.force_n),
            glm::dvec3(thick_mm, thick_mm, length_mm + 3.0 * grown_mm));
    };
    const glm::dmat4 view_projection = camera.projection(covered.size_px()) * camera.view();
    program_.use();
    // Back faces must not show through it.
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    draw_mesh(arrow_outline_, placed(outline_mm), view_projection, {}, covered);
    draw_mesh(arrow_, placed(0.0), view_projection, {}, covered);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
}

void ToolRenderer::draw_seen_through(const DrawnTool& tool, const Camera& camera,
                                     const glm::ivec2& size_px) const {
    const glm::dmat4 view_projection = camera.projection(size_px) * camera.view();
    program_.use();
    if (const double opacity = handpiece_opacity(tool, camera); opacity > 0.0 && opacity < 1.0) {
        place_mesh(pose_of_handpiece(tool), view_projection,
                   {.opacity = static_cast<float>(opacity), .polish = 1.0f});
        draw_translucent(handpiece_);
    }
    const HiddenField field = field_of(tool, camera, size_px);
    if (!field.is_before_eye) return;
    const glm::dvec2 middle = glm::clamp(field.middle_px, -1e6, 1e6);
    const double reach = std::min(edge_radii * field.radius_px, 1e6) + 1.0;
    const glm::ivec2 first = glm::max(glm::ivec2(middle - reach), 0);
    const glm::ivec2 end = glm::min(glm::ivec2(middle + reach) + 1, size_px);
    if (end.x <= first.x || end.y <= first.y) return;
    place_mesh(pose_of(tool), view_projection, {.polish = 1.0f, .sees_through = leave_only});
    glEnable(GL_SCISSOR_TEST);
    glScissor(first.x, first.y, end.x - first.x, end.y - first.y);
    draw_translucent(shank_);
    glDisable(GL_SCISSOR_TEST);
}

void ToolRenderer::draw_mesh(const gl::Mesh& mesh, const glm::dmat4& model, const glm::dmat4& view_projection,
                             const Finish& finish, TileMask& covered) const {
    mark_box(covered, mesh.low(), mesh.high(), view_projection * model);
    place_mesh(model, view_projection, finish);
    mesh.draw();
}

void ToolRenderer::place_mesh(const glm::dmat4& model, const glm::dmat4& view_projection,
                              const Finish& finish) const {
    program_.set("to_clip", glm::mat4(view_projection * model));
    program_.set("to_patient", glm::mat4(model));
    program_.set("normal_to_patient", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(model)))));
    program_.set("opacity", finish.opacity);
    program_.set("polish", finish.polish);
    program_.set("sees_through", finish.sees_through);
}

}  // namespace osteomill
