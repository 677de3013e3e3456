#include "render_client/ui/panels/fixture_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

namespace osteomill {

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
