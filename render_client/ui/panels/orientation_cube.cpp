#include "render_client/ui/panels/orientation_cube.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// Half the edge of a cube whose diagonal is the square's side.
constexpr double half_edge = 0.5 / std::numbers::sqrt3;

struct Side {
    char letter;
    glm::dvec3 outward;
};

constexpr std::array<Side, 6> sides{{{'L', {1, 0, 0}},
                                     {'R', {-1, 0, 0}},
                                     {'P', {0, 1, 0}},
                                     {'A', {0, -1, 0}},
                                     {'S', {0, 0, 1}},
                                     {'I', {0, 0, -1}}}};

double cross_2d(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

bool holds(const CubeFace& face, const glm::dvec2& point) {
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2& corner = face.corners[i];
        (cross_2d(face.corners[(i + 1) % 4] - corner, point - corner) < 0.0 ? left : right) += 1;
    }
    return left == 0 || right == 0;
}

}  // namespace

std::vector<CubeFace> visible_faces(const Camera& camera) {
    const auto in_square = [&](const glm::dvec3& place) {
        return glm::dvec2(0.5 + glm::dot(place, camera.right()), 0.5 - glm::dot(place, camera.up()));
    };
    std::vector<CubeFace> faces;
    for (const Side& side : sides) {
        const double facing = -glm::dot(side.outward, camera.forward());
        if (facing < 1e-3) continue;
        CubeFace face{.letter = side.letter, .outward = side.outward, .facing = facing, .corners = {}};
        const glm::dvec3 aside(side.outward.y, side.outward.z, side.outward.x);
        const glm::dvec3 across = glm::cross(side.outward, aside);
        const glm::dvec3 middle = half_edge * side.outward;
        face.middle = in_square(middle);
        face.corners = {in_square(middle + half_edge * (aside + across)),
                        in_square(middle + half_edge * (across - aside)),
                        in_square(middle - half_edge * (aside + across)),
                        in_square(middle + half_edge * (aside - across))};
        faces.push_back(face);
    }
    return faces;
}

std::optional<CubeFace> face_at(const Camera& camera, const glm::dvec2& point) {
    for (const CubeFace& face : visible_faces(camera))
        if (holds(face, point)) return face;
    return std::nullopt;
}

void look_at_side(Camera& camera, const glm::dvec3& outward) {
    // From above or below the azimuth is free: with 0 the patient's front is at the picture's lower edge.
    const double level = std::hypot(outward.x, outward.y);
    const double azimuth_rad = level > 1e-6 ? std::atan2(outward.x, -outward.y) : 0.0;
    const double elevation_rad = std::atan2(outward.z, level);
    orbit(camera, azimuth_rad - camera.azimuth_rad, elevation_rad - camera.elevation_rad);
}

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
