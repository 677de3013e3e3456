#include "render_client/ui/panels/fixture_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// Distance from the burr to the place at which the fixture begins to act; nothing if it is not known.
std::optional<double> distance_mm(const SeenSession& session, const Fixture& fixture) {
    if (fixture.kind == FixtureKind::guide) {
        const glm::dvec3& burr_mm = session.tool->burr_position_mm;
        return std::max(0.0, glm::distance(burr_mm, nearest_of_path(fixture, burr_mm)) - fixture.radius_mm);
    }
    for (const StructureDistance& structure : session.link.distances)
        if (structure.distance_mm && session.info->tissues[structure.tissue].name == fixture.tissue)
            return *structure.distance_mm - fixture.distance_mm;
    return std::nullopt;
}

std::string acting_words(const Fixture& fixture, std::optional<double> distance_mm) {
    switch (fixture.kind) {
        case FixtureKind::guide:
            return trf("guides, {:.2f} mm off", distance_mm.value_or(0.0));
        case FixtureKind::forbidden:
            return trf("holds {} off", tissue_words(fixture.tissue));
        case FixtureKind::slow:
            break;
    }
    return tr("slows");
}

TextLine line_of(const SeenSession& session, const Fixture& fixture, bool is_on, bool acts) {
    const auto line = [&](Tone tone, const std::string& state) {
        return TextLine{{tone, fixture.name + ": " + state}};
    };
    if (!is_on) return line(Tone::dim, tr("off"));
    const std::optional<double> away_mm = distance_mm(session, fixture);
    if (acts) return line(Tone::good, acting_words(fixture, away_mm));
    if (away_mm) return line(Tone::plain, trf("{:.1f} mm away", std::max(*away_mm, 0.0)));
    return line(Tone::plain, tr("not near"));
}

}  // namespace

PanelText fixture_text(const SeenSession& session) {
    PanelText text;
    if (!session.info || !session.tool) return text;
    const std::vector<Fixture>& fixtures = session.info->fixtures;
    for (std::size_t i = 0; i < fixtures.size(); ++i)
        text.push_back(line_of(session, fixtures[i], has_fixture(session.tool->fixtures_on, i),
                               has_fixture(session.tool->fixtures_acting, i)));
    return text;
}

glm::vec2 fixture_panel_size(const PanelText& text) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 0.0f;
    for (const TextLine& line : text)
        width = std::max(width, ImGui::CalcTextSize(line.front().text.c_str()).x);
    return {
        std::ceil(width + ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + 2.0f * style.WindowPadding.x),
        static_cast<float>(text.size()) * ImGui::GetFrameHeightWithSpacing() - style.ItemSpacing.y +
            2.0f * style.WindowPadding.y};
}

void draw_fixture_panel(const SeenSession& session, const Theme& theme, const PanelText& text,
                        const PanelPlace& place, SessionRequests& requests) {
    const WidgetPanel window("fixtures", place);
    const SessionStatus& can = session.link.controls;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const TextPiece& words = text[i].front();
        bool is_on = has_fixture(session.tool->fixtures_on, i);
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text, colour_of(theme[words.tone]));
        ImGui::BeginDisabled(!can.is_paused || !can.may_control);
        // The words may have what Dear ImGui takes for a sign.
        if (ImGui::Checkbox("##on", &is_on))
            requests.controls.push_back(
                {.action = SessionAction::fixture, .text = session.info->fixtures[i].name, .is_on = is_on});
        ImGui::EndDisabled();
        const bool is_hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
        ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(words.text.c_str());
        ImGui::PopStyleColor();
        if (is_hovered)
            ImGui::SetTooltip(
                "%s",
                can.is_paused
                    ? tr("help by force, on or off")
                    : trf("pause first ({}): then it is switched on or off", key_of(Action::hold)).c_str());
        ImGui::PopID();
    }
}

namespace {

constexpr double least_ring_mm = 2.0;  // of a plane, to be seen

glm::dvec3 nearest_of(const LineGuide& line, const glm::dvec3& burr_mm) {
    const glm::dvec3 along_mm = line.to_mm - line.from_mm;
    const double share = glm::dot(burr_mm - line.from_mm, along_mm) / glm::dot(along_mm, along_mm);
    return line.from_mm + std::clamp(share, 0.0, 1.0) * along_mm;
}

glm::dvec3 nearest_of(const PlaneGuide& plane, const glm::dvec3& burr_mm) {
    return burr_mm + glm::dot(plane.at_mm - burr_mm, plane.normal) * plane.normal;
}

/// Lines in patient LPS, on a picture.
class LinePainter {
  public:
    LinePainter(const PanelPainter& painter, const Camera& camera, const glm::ivec2& size_px, bool acts)
        : painter_(painter), camera_(camera), size_px_(size_px), acts_(acts) {}

    /// In pieces, so that only those before the eye are drawn.
    void draw_line(const glm::dvec3& from_mm, const glm::dvec3& to_mm) const {
        constexpr int pieces = 32;
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= pieces; ++i)
            points.push_back(glm::mix(from_mm, to_mm, static_cast<double>(i) / pieces));
        draw(points);
    }
    void draw_ring(const glm::dvec3& middle_mm, const glm::dvec3& axis, double radius_mm) const {
        constexpr int corners = 48;
        const glm::dvec3 beside = std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(axis, beside));
        const glm::dvec3 v = glm::cross(axis, u);
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= corners; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / corners;
            points.push_back(middle_mm + radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
        }
        draw(points);
    }
    void draw_dot(const glm::dvec3& at_mm) const {
        if (!camera_.has_in_front(at_mm)) return;
        painter_.canvas().AddDrawCmd();
        for (const auto& [colour, radius_px] : {std::pair{dark(), 4.0f}, std::pair{ink(), 3.0f}})
            painter_.canvas().AddCircleFilled(on_picture(at_mm), radius_px * painter_.scale(), colour);
    }

  private:
    ImU32 dark() const { return colour_of(painter_.theme().behind_letter); }
    ImU32 ink() const { return colour_of(painter_.theme()[acts_ ? Tone::good : Tone::back]); }
    ImVec2 on_picture(const glm::dvec3& at_mm) const {
        return to_imgui(glm::vec2(glm::clamp(pixel_of(camera_, at_mm, size_px_), -1e5, 1e5)));
    }
    void draw(const std::vector<glm::dvec3>& points_mm) const {
        std::vector<ImVec2> run;
        const auto end_run = [&] {
            if (run.size() > 1) {
                painter_.canvas().AddDrawCmd();
                const float width_px = acts_ ? 2.5f : 1.5f;
                for (const auto& [colour, wider_px] : {std::pair{dark(), 2.0f}, std::pair{ink(), 0.0f}})
                    painter_.canvas().AddPolyline(run.data(), static_cast<int>(run.size()), colour,
                                                  ImDrawFlags_None, (width_px + wider_px) * painter_.scale());
            }
            run.clear();
        };
        for (const glm::dvec3& point_mm : points_mm)
            if (camera_.has_in_front(point_mm))
                run.push_back(on_picture(point_mm));
            else
                end_run();
        end_run();
    }

    const PanelPainter& painter_;
    const Camera& camera_;
    glm::ivec2 size_px_;
    bool acts_;
};

void draw_path(const LinePainter& lines, const LineGuide& line, double radius_mm, const glm::dvec3& eye_mm) {
    const glm::dvec3 along = glm::normalize(line.to_mm - line.from_mm);
    lines.draw_line(line.from_mm, line.to_mm);
    for (const glm::dvec3& end_mm : {line.from_mm, line.to_mm})
        radius_mm > 0.0 ? lines.draw_ring(end_mm, along, radius_mm) : lines.draw_dot(end_mm);
    const glm::dvec3 across = glm::cross(along, eye_mm - line.from_mm);
    if (radius_mm == 0.0 || glm::length(across) < 1e-6) return;
    // A tube's outline.
    const glm::dvec3 aside_mm = radius_mm * glm::normalize(across);
    for (const double side : {-1.0, 1.0})
        lines.draw_line(line.from_mm + side * aside_mm, line.to_mm + side * aside_mm);
}

void draw_guide(const LinePainter& lines, const Fixture& guide, const glm::dvec3& burr_mm,
                double burr_radius_mm, const glm::dvec3& eye_mm) {
    if (const auto* line = std::get_if<LineGuide>(&guide.path))
        draw_path(lines, *line, guide.radius_mm, eye_mm);
    if (const auto* plane = std::get_if<PlaneGuide>(&guide.path)) {
        const glm::dvec3 foot_mm = nearest_of(*plane, burr_mm);
        const double ring_mm = std::max(2.0 * burr_radius_mm, least_ring_mm);
        for (const double side : {-1.0, 1.0}) {
            lines.draw_ring(foot_mm + side * guide.radius_mm * plane->normal, plane->normal, ring_mm);
            if (guide.radius_mm == 0.0) break;
        }
    }
}

}  // namespace

glm::dvec3 nearest_of_path(const Fixture& guide, const glm::dvec3& burr_mm) {
    return std::visit([&](const auto& path) { return nearest_of(path, burr_mm); }, guide.path);
}

void draw_guides(const PanelPainter& painter, const SeenSession& session, const Camera& camera,
                 const glm::ivec2& size_px) {
    const ToolState& tool = *session.tool;
    for (std::size_t i = 0; i < session.info->fixtures.size(); ++i) {
        const Fixture& fixture = session.info->fixtures[i];
        if (fixture.kind != FixtureKind::guide || !has_fixture(tool.fixtures_on, i)) continue;
        const bool acts = has_fixture(tool.fixtures_acting, i);
        const LinePainter lines(painter, camera, size_px, acts);
        draw_guide(lines, fixture, tool.burr_position_mm, session.burr_radius_mm(), camera.eye_mm());
        if (acts) lines.draw_line(tool.burr_position_mm, nearest_of_path(fixture, tool.burr_position_mm));
    }
}

}  // namespace osteomill
