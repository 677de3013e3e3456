#include "render_client/ui/panels/picture_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "common/words/translation.h"
#include "render_client/ui/panels/round_number.h"
#include "render_client/volume/surface_points.h"
#include "render_client/volume/tool/tool_renderer.h"

namespace osteomill {

ScaleBar scale_bar(double mm_per_px, double longest_px) {
    const double length_mm = round_number_up_to(mm_per_px * longest_px);
    const std::string label =
        length_mm < 0.999 ? fmt::format("{:g} µm", 1e3 * length_mm) : fmt::format("{:g} mm", length_mm);
    return {length_mm, length_mm / mm_per_px, with_decimal_sign(label)};
}

ScaleBar scale_bar_of(const Camera& camera, const glm::ivec2& size_px) {
    return scale_bar(mm_per_px_at(camera, camera.target_mm, size_px), std::max(0.2 * size_px.x, 1.0));
}

glm::vec2 scale_bar_size(const PanelPainter& painter, const ScaleBar& bar) {
    const float width = std::max(static_cast<float>(bar.length_px), painter.width_of(bar.label));
    return glm::ceil(glm::vec2(width, 1.7f * ImGui::GetFontSize()) + painter.padding());
}

void draw_scale_bar(const PanelPainter& painter, const ScaleBar& bar, const PanelPlace& place) {
    ImDrawList& canvas = painter.canvas();
    const ImU32 ink = colour_of(painter.theme().on_picture);
    canvas.AddDrawCmd();
    canvas.AddRectFilled(to_imgui(place.first), to_imgui(place.first + place.size),
                         colour_of(painter.theme().behind_letter), 3.0f * painter.scale());
    const float middle = place.first.x + 0.5f * place.size.x;
    const float half = 0.5f * static_cast<float>(bar.length_px);
    const float y = place.first.y + place.size.y - painter.padding();
    const float tick = 4.0f * painter.scale();
    const float thickness = 2.0f * painter.scale();
    canvas.AddLine({middle - half, y}, {middle + half, y}, ink, thickness);
    for (const float end : {middle - half, middle + half})
        canvas.AddLine({end, y - tick}, {end, y + tick}, ink, thickness);
    painter.draw_text(
        {middle - 0.5f * painter.width_of(bar.label), place.first.y + 0.25f * painter.padding()},
        painter.theme().on_picture, bar.label);
}

void draw_force_label(const PanelPainter& painter, const ToolState& tool, double burr_radius_mm,
                      const Camera& camera, const glm::ivec2& size_px,
                      std::span<const std::optional<PanelPlace>> panels) {
    const auto arrow = force_arrow(tool, burr_radius_mm, camera, size_px);
    if (!arrow || !camera.has_in_front(arrow->head_mm)) return;
    const double force_n = glm::length(tool.force_n);
    const glm::vec2 head(pixel_of(camera, arrow->head_mm, size_px));
    const float beside = 8.0f * painter.scale();
    const std::string text = spoken_number("{:.2f} N", force_n);
    const glm::vec2 size(painter.width_of(text), ImGui::GetFontSize());
    const glm::vec2 middle = head - 0.5f * size;
    const glm::vec2 across(0.5f * size.x + beside, 0.0f), along(0.0f, size.y + beside);
    const std::array places{middle + across,         middle - across,         middle - along,
                            middle + along,          middle + across - along, middle + across + along,
                            middle - across - along, middle - across + along};
    if (const auto place = free_place(places, size, panels, size_px)) painter.draw_on_picture(*place, text);
}

namespace {

/// Whether the burr's head stands between an eye and a place. What of the shank could is seen through.
bool is_behind_burr(const glm::dvec3& burr_mm, double radius_mm, const glm::dvec3& eye_mm,
                    const glm::dvec3& place_mm) {
    const glm::dvec3 way = place_mm - eye_mm;
    const double nearest = glm::dot(burr_mm - eye_mm, way) / glm::dot(way, way);
    return nearest > 0.0 && nearest < 1.0 && glm::distance(eye_mm + nearest * way, burr_mm) < radius_mm;
}

}  // namespace

std::optional<TouchRing> touch_ring(const Bone& bone, const ToolState& tool, double burr_radius_mm,
                                    const glm::dvec3& eye_mm, std::span<const CutPlane> cuts) {
    const auto ahead_mm = bone_ahead_mm(bone, tool, burr_radius_mm);
    if (!ahead_mm || *ahead_mm <= bone.grid().spacing_mm) return std::nullopt;
    const glm::dvec3 middle_mm = tool.burr_position_mm - (burr_radius_mm + *ahead_mm) * tool.spindle_axis;
    // Over the bone, not through it.
    if (is_cut_away(middle_mm, cuts) || is_behind_bone(bone, eye_mm, middle_mm, cuts)) return std::nullopt;
    const glm::dvec3 beside = std::abs(tool.spindle_axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(tool.spindle_axis, beside));
    const glm::dvec3 v = glm::cross(tool.spindle_axis, u);
    TouchRing ring;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / ring.size();
        const glm::dvec3 at_mm = middle_mm + burr_radius_mm * (std::cos(angle) * u + std::sin(angle) * v);
        if (!is_cut_away(at_mm, cuts) &&
            !is_behind_burr(tool.burr_position_mm, burr_radius_mm, eye_mm, at_mm))
            ring[i] = at_mm;
    }
    return ring;
}

void draw_touch_ring(const PanelPainter& painter, const TouchRing& ring, const Camera& camera,
                     const glm::ivec2& size_px) {
    painter.canvas().AddDrawCmd();
    for (const auto& [colour, width_px] :
         {std::pair{painter.theme().behind_letter, 4.0f}, std::pair{painter.theme()[Tone::back], 2.0f}})
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto& from_mm = ring[i];
            const auto& to_mm = ring[(i + 1) % ring.size()];
            if (from_mm && to_mm && camera.has_in_front(*from_mm) && camera.has_in_front(*to_mm))
                painter.canvas().AddLine(to_imgui(glm::vec2(pixel_of(camera, *from_mm, size_px))),
                                         to_imgui(glm::vec2(pixel_of(camera, *to_mm, size_px))),
                                         colour_of(colour), width_px * painter.scale());
        }
}

void draw_veil(const PanelPainter& painter, const glm::ivec2& size_px) {
    constexpr ImU32 grey = IM_COL32(110, 110, 110, 190);
    painter.canvas().AddDrawCmd();
    painter.canvas().AddRectFilled({0.0f, 0.0f}, to_imgui(glm::vec2(size_px)), grey);
}

void draw_alarm_frame(const PanelPainter& painter, const glm::ivec2& size_px) {
    const float thickness = 6.0f * painter.scale();
    painter.canvas().AddDrawCmd();
    painter.canvas().AddRect(to_imgui(glm::vec2(0.5f * thickness)),
                             to_imgui(glm::vec2(size_px) - 0.5f * thickness),
                             colour_of(painter.theme()[Tone::warning]), 0.0f, ImDrawFlags_None, thickness);
}

}  // namespace osteomill
