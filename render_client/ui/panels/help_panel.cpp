#include "render_client/ui/panels/help_panel.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <sstream>
#include <string>
#include <utility>

namespace osteomill {

namespace {

constexpr std::size_t most_columns = 3;

HelpColumn column_of(const PanelPainter& painter, std::span<const HelpLine> lines) {
    HelpColumn column{.rows = lines.size()};
    for (const HelpLine& line : lines) column.names = std::max(column.names, painter.width_of(line.name));
    column.names += ImGui::GetFontSize();
    for (const HelpLine& line : lines)
        column.meanings = std::max(
            column.meanings, painter.width_of(line.meaning) - (line.name.empty() ? column.names : 0.0f));
    return column;
}

/// Columns of at most so many rows; none ends with a heading.
std::vector<std::span<const HelpLine>> split(std::span<const HelpLine> lines, std::size_t rows) {
    std::vector<std::span<const HelpLine>> columns;
    while (!lines.empty()) {
        std::size_t count = std::min(rows, lines.size());
        while (count > 1 && count < lines.size() && lines[count - 1].is_heading) --count;
        columns.push_back(lines.first(count));
        lines = lines.subspan(count);
    }
    return columns;
}

HelpLayout in_columns(const PanelPainter& painter, std::vector<HelpLine> lines, std::size_t count) {
    HelpLayout layout;
    layout.lines = std::move(lines);
    std::size_t rows = (layout.lines.size() + count - 1) / count;
    while (split(layout.lines, rows).size() > count) ++rows;
    for (const std::span<const HelpLine> part : split(layout.lines, rows)) {
        layout.columns.push_back(column_of(painter, part));
        layout.size.x += layout.columns.back().names + layout.columns.back().meanings;
    }
    const glm::vec2 gaps(static_cast<float>(layout.columns.size() - 1) * ImGui::GetFontSize(), 0.0f);
    layout.size.y = static_cast<float>(rows) * painter.line_height();
    layout.size = glm::ceil(layout.size + gaps + 2.0f * painter.padding());
    return layout;
}

/// Meanings wrapped to `widest` px; what goes on stands under the meaning, behind a name of a space.
std::vector<HelpLine> wrapped(const PanelPainter& painter, const std::vector<HelpLine>& lines, float widest) {
    std::vector<HelpLine> rows;
    for (const HelpLine& line : lines) {
        rows.push_back({line.name, "", line.is_heading});
        std::istringstream words(line.meaning);
        for (std::string word; words >> word;) {
            std::string& row = rows.back().meaning;
            const std::string longer = row.empty() ? word : row + ' ' + word;
            if (row.empty() || painter.width_of(longer) <= widest)
                row = longer;
            else
                rows.push_back({line.name.empty() ? "" : " ", word, line.is_heading});
        }
    }
    return rows;
}

/// Columns that fit in this width with the smallest letters that can be read.
HelpLayout in_narrow_columns(const PanelPainter& painter, const std::vector<HelpLine>& lines,
                             std::size_t count, float room_x) {
    const auto parts = static_cast<float>(count);
    const float one = (std::floor(room_x / small_print) - 2.0f * painter.padding() -
                       (parts - 1.0f) * ImGui::GetFontSize()) /
                      parts;
    return in_columns(painter, wrapped(painter, lines, one - column_of(painter, lines).names), count);
}

float letters_in(const glm::vec2& room, const HelpLayout& layout) {
    return std::min({1.0f, room.x / layout.size.x, room.y / layout.size.y});
}

}  // namespace

HelpLayout lay_out_help(const PanelPainter& painter, Situation situation, const glm::vec2& room) {
    const std::vector<HelpLine> lines = help_lines(situation);
    HelpLayout best = in_columns(painter, lines, 1);
    // If several are equal, the fewest columns, and whole lines before wrapped ones.
    const auto try_also = [&](HelpLayout next) {
        if (letters_in(room, next) > letters_in(room, best)) best = std::move(next);
    };
    for (std::size_t count = 2; count <= most_columns; ++count) try_also(in_columns(painter, lines, count));
    for (std::size_t count = 1; count <= most_columns; ++count)
        if (letters_in(room, best) < small_print) try_also(in_narrow_columns(painter, lines, count, room.x));
    // Below a third nobody could read it: rather the size that lay_out leaves out.
    best.letters = std::max(letters_in(room, best), 0.3f);
    best.size *= best.letters;
    return best;
}

void draw_help(const PanelPainter& painter, const HelpLayout& help, const PanelPlace& place) {
    painter.draw_background(place);
    glm::vec2 pen = place.first + help.letters * painter.padding();
    auto line = help.lines.begin();
    for (const HelpColumn& column : help.columns) {
        glm::vec2 at = pen;
        for (std::size_t row = 0; row < column.rows; ++row, ++line) {
            painter.draw_text(at, painter.theme()[Tone::left], line->name, help.letters);
            painter.draw_text({at.x + (line->name.empty() ? 0.0f : help.letters * column.names), at.y},
                              painter.theme()[line->is_heading ? Tone::dim : Tone::plain], line->meaning,
                              help.letters);
            at.y += help.letters * painter.line_height();
        }
        pen.x += help.letters * (column.names + column.meanings + ImGui::GetFontSize());
    }
}

}  // namespace osteomill
