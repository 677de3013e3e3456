#include "render_client/ui/panels/inset_panel.h"

#include <algorithm>

#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr float part_of_lesser_side = 0.3f;

}  // namespace

int inset_edge_px(const glm::vec2& picture) {
    return std::max(1, static_cast<int>(part_of_lesser_side * std::min(picture.x, picture.y)));
}

Anchor inset_anchor(const glm::dvec2& burr_px, const glm::vec2& picture) {
    const double near_px = 1.5 * inset_edge_px(picture);
    return burr_px.x < near_px && burr_px.y < near_px ? Anchor::upper_right : Anchor::upper_left;
}

void draw_inset(const PanelPainter& painter, const gl::Framebuffer& inset, InsetKind kind,
                double burr_diameter_mm, const PanelPlace& place) {
    const glm::vec2 end = place.first + place.size;
    const bool is_axial = kind == InsetKind::axial;
    // OpenGL counts rows from below; see axial_camera for the mirror.
    painter.canvas().AddImage(texture_of(inset.colour_texture()), to_imgui(place.first), to_imgui(end),
                              {is_axial ? 1.0f : 0.0f, 1.0f}, {is_axial ? 0.0f : 1.0f, 0.0f});
    painter.canvas().AddRect(to_imgui(place.first), to_imgui(end), colour_of(painter.theme().on_picture));
    const float padding = painter.padding();
    painter.draw_on_picture(place.first + padding, is_axial ? tr("axial") : tr("endoscope"));
    if (!is_axial) return;
    const auto burr_px = static_cast<float>(burr_diameter_mm / axial_width_mm) * place.size.x;
    painter.canvas().AddCircle(to_imgui(0.5f * (place.first + end)), std::max(0.5f * burr_px, 2.0f),
                               colour_of(painter.theme().on_picture), 0, 1.5f * painter.scale());
    const float row = place.first.y + 0.5f * (place.size.y - painter.line_height());
    painter.draw_on_picture({place.first.x + padding, row}, "R");
    painter.draw_on_picture({end.x - padding - painter.width_of("L"), row}, "L");
}

}  // namespace osteomill
