#include "render_client/ui/view/inset_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace osteomill {

namespace {

constexpr double up_the_handpiece_mm = 10.0;
constexpr double beside_it_mm = 4.0;
constexpr double endoscope_angle_rad = 1.2;
constexpr double axial_distance_mm = 150.0;

/// The axial picture moves in steps: a hand's tremor is no reason to draw all of it anew.
constexpr double axial_step_mm = 0.05;

glm::dvec3 stepped(const glm::dvec3& position_mm) {
    return axial_step_mm * glm::round(position_mm / axial_step_mm);
}

}  // namespace

Camera endoscope_camera(const glm::dvec3& burr_mm, const glm::dvec3& spindle_axis) {
    const glm::dvec3 front(0.0, -1.0, 0.0), above(0.0, 0.0, 1.0);
    const glm::dvec3 towards = std::abs(spindle_axis.y) < 0.9 ? front : above;
    const glm::dvec3 aside = glm::normalize(towards - glm::dot(towards, spindle_axis) * spindle_axis);
    const glm::dvec3 to_eye_mm = up_the_handpiece_mm * spindle_axis + beside_it_mm * aside;
    Camera camera{.target_mm = burr_mm,
                  .distance_mm = glm::length(to_eye_mm),
                  .field_of_view_rad = endoscope_angle_rad,
                  .near_mm = 0.5,
                  .far_mm = 300.0};
    look_along(camera, -glm::normalize(to_eye_mm));
    return camera;
}

Camera axial_camera(const glm::dvec3& burr_mm) {
    return {.target_mm = stepped(burr_mm),
            .distance_mm = axial_distance_mm,
            .azimuth_rad = std::numbers::pi,
            .elevation_rad = 0.5 * std::numbers::pi,
            .field_of_view_rad = 2.0 * std::atan(0.5 * axial_width_mm / axial_distance_mm),
            .near_mm = 1.0,
            .far_mm = 1000.0};
}

CutPlane axial_cut(const glm::dvec3& burr_mm) {
    return {.normal = {0.0, 0.0, 1.0}, .offset_mm = stepped(burr_mm).z};
}

InsetView::InsetView(RendererChoice renderer)
    : renderer_(make_renderer(renderer)), picture_(*renderer_, {1, 1}) {}

const gl::Framebuffer& InsetView::draw(InsetKind kind, const BoneTextures& bone, const DrawnTool& tool,
                                       SceneAppearance look, int edge_px) {
    const glm::dvec3& burr_mm = tool.state.burr_position_mm;
    const bool is_axial = kind == InsetKind::axial;
    look.light_field = false;
    if (is_axial) look.cuts = {axial_cut(burr_mm)};
    picture_.resize({edge_px, edge_px});
    picture_.set_appearance(look);
    // The handpiece would hide the section; the panel marks the burr.
    return picture_.draw(
        &bone, is_axial ? nullptr : &tool,
        is_axial ? axial_camera(burr_mm) : endoscope_camera(burr_mm, tool.state.spindle_axis));
}

}  // namespace osteomill
