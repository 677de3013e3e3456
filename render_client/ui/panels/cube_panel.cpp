#include "render_client/ui/panels/cube_panel.h"

#include <array>

#include "render_client/ui/panels/orientation_cube.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// Brighter the more a face is turned to the eye, so that the edges between them show.
Rgba shaded(const Rgba& colour, double facing) {
    const auto part = [&](std::uint8_t value) {
        return static_cast<std::uint8_t>(value * (0.55 + 0.45 * facing));
    };
    return {part(colour.r), part(colour.g), part(colour.b), 235};
}

}  // namespace

glm::vec2 cube_size(const PanelPainter& painter) {
    return glm::vec2(84.0f * painter.scale());
}

void draw_cube(const PanelPainter& painter, Camera& camera, const PanelPlace& place) {
    const auto in_picture = [&](const glm::dvec2& point) {
        return place.first + glm::vec2(point) * place.size;
    };
    painter.canvas().AddDrawCmd();
    for (const CubeFace& face : visible_faces(camera)) {
        std::array<ImVec2, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) corners[i] = to_imgui(in_picture(face.corners[i]));
        const Rgba& control = painter.theme().control;
        painter.canvas().AddConvexPolyFilled(corners.data(), 4, colour_of(shaded(control, face.facing)));
        painter.canvas().AddPolyline(corners.data(), 4, colour_of(painter.theme().on_picture),
                                     ImDrawFlags_Closed, painter.scale());
        // A letter on a face seen from its edge would lie on the neighbour's.
        if (face.facing < 0.2) continue;
        const std::string letter(1, face.letter);
        const glm::vec2 half(0.5f * painter.width_of(letter), 0.5f * ImGui::GetFontSize());
        painter.draw_text(in_picture(face.middle) - half, painter.theme()[Tone::plain], letter);
    }
    const WidgetPanel window("cube", place, WidgetPanel::Background::none);
    ImGui::SetCursorPos({0.0f, 0.0f});
    if (!ImGui::InvisibleButton("side", to_imgui(place.size))) return;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (const auto face = face_at(
            camera, (glm::dvec2(mouse.x, mouse.y) - glm::dvec2(place.first)) / glm::dvec2(place.size)))
        look_at_side(camera, face->outward);
}

}  // namespace osteomill
