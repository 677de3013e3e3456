#include "render_client/ui/panels/help_panel.h"

#include <algorithm>
#include <glm/common.hpp>

namespace osteomill {

namespace {

float name_column(const PanelPainter& painter, const std::vector<HelpLine>& lines) {
    float widest = 0.0f;
    for (const HelpLine& line : lines) widest = std::max(widest, painter.width_of(line.name));
    return widest + ImGui::GetFontSize();
}

glm::vec2 full_size(const PanelPainter& painter, const std::vector<HelpLine>& lines) {
    const float names = name_column(painter, lines);
    glm::vec2 size(0.0f, static_cast<float>(lines.size()) * painter.line_height());
    for (const HelpLine& line : lines)
        size.x = std::max(size.x, (line.name.empty() ? 0.0f : names) + painter.width_of(line.meaning));
    return glm::ceil(size + 2.0f * painter.padding());
}

}  // namespace

glm::vec2 help_size(const PanelPainter& painter, Situation situation, const glm::vec2& room) {
    const glm::vec2 size = full_size(painter, help_lines(situation));
    const float factor = std::min({1.0f, room.x / size.x, room.y / size.y});
    // Below a third nobody could read it: rather the size that lay_out leaves out.
    return std::max(factor, 0.3f) * size;
}

void draw_help(const PanelPainter& painter, Situation situation, const PanelPlace& place) {
    const std::vector<HelpLine> lines = help_lines(situation);
    const float factor = place.size.x / full_size(painter, lines).x;
    const float names = factor * name_column(painter, lines);
    painter.draw_background(place);
    glm::vec2 pen = place.first + factor * painter.padding();
    for (const HelpLine& line : lines) {
        painter.draw_text(pen, painter.theme()[Tone::left], line.name, factor);
        painter.draw_text({pen.x + (line.name.empty() ? 0.0f : names), pen.y},
                          painter.theme()[line.is_heading ? Tone::dim : Tone::plain], line.meaning, factor);
        pen.y += factor * painter.line_height();
    }
}

}  // namespace osteomill
