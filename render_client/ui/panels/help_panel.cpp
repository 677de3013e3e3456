#include "render_client/ui/panels/help_panel.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace osteomill {

namespace {

constexpr std::size_t most_columns = 3;

struct Column {
    std::span<const HelpLine> lines;
    float names = 0.0f, meanings = 0.0f;  // widths, px at the usual size of letters
};

struct Columns {
    std::vector<HelpLine> lines;
    std::vector<Column> all;  // of these lines
    glm::vec2 size{0.0f};  // of the panel, px at the usual size of letters
};

Column column_of(const PanelPainter& painter, std::span<const HelpLine> lines) {
    Column column{.lines = lines};
    for (const HelpLine& line : lines) column.names = std::max(column.names, painter.width_of(line.name));
    column.names += ImGui::GetFontSize();
    for (const HelpLine& line : lines)
        column.meanings = std::max(column.meanings, painter.width_of(line.meaning) -
                                                        (line.name.empty() ? column.names : 0.0f));
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

Columns in_columns(const PanelPainter& painter, std::vector<HelpLine> lines, std::size_t count) {
    Columns columns;
    columns.lines = std::move(lines);
    std::size_t rows = (columns.lines.size() + count - 1) / count;
    while (split(columns.lines, rows).size() > count) ++rows;
    for (const std::span<const HelpLine> part : split(columns.lines, rows)) {
        columns.all.push_back(column_of(painter, part));
        columns.size.x += columns.all.back().names + columns.all.back().meanings;
    }
    const glm::vec2 gaps(static_cast<float>(columns.all.size() - 1) * ImGui::GetFontSize(), 0.0f);
    columns.size.y = static_cast<float>(rows) * painter.line_height();
    columns.size = glm::ceil(columns.size + gaps + 2.0f * painter.padding());
    return columns;
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

/// Columns that fit in a room so wide with the smallest letters that can be read.
Columns in_narrow_columns(const PanelPainter& painter, const std::vector<HelpLine>& lines, std::size_t count,
                          float room_x) {
    const auto parts = static_cast<float>(count);
    const float one =
        (room_x / small_print - 2.0f * painter.padding() - (parts - 1.0f) * ImGui::GetFontSize()) / parts;
    return in_columns(painter, wrapped(painter, lines, one - column_of(painter, lines).names), count);
}

float factor_in(const glm::vec2& room, const Columns& columns) {
    return std::min({1.0f, room.x / columns.size.x, room.y / columns.size.y});
}

/// The columns whose letters are the largest in that room; of equal ones the fewest, and rather whole lines.
Columns best_columns(const PanelPainter& painter, const std::vector<HelpLine>& lines, const glm::vec2& room) {
    Columns best = in_columns(painter, lines, 1);
    const auto try_also = [&](Columns next) {
        if (factor_in(room, next) > factor_in(room, best)) best = std::move(next);
    };
    for (std::size_t count = 2; count <= most_columns; ++count) try_also(in_columns(painter, lines, count));
    for (std::size_t count = 1; count <= most_columns; ++count)
        if (factor_in(room, best) < small_print)
            try_also(in_narrow_columns(painter, lines, count, room.x));
    return best;
}

}  // namespace

float help_letters(const PanelPainter& painter, Situation situation, const glm::vec2& room) {
    return factor_in(room, best_columns(painter, help_lines(situation), room));
}

glm::vec2 help_size(const PanelPainter& painter, Situation situation, const glm::vec2& room) {
    const Columns columns = best_columns(painter, help_lines(situation), room);
    // Below a third nobody could read it: rather the size that lay_out leaves out.
    return std::max(factor_in(room, columns), 0.3f) * columns.size;
}

void draw_help(const PanelPainter& painter, Situation situation, const PanelPlace& place) {
    const Columns columns = best_columns(painter, help_lines(situation), place.size);
    const float factor = place.size.x / columns.size.x;
    painter.draw_background(place);
    glm::vec2 pen = place.first + factor * painter.padding();
    for (const Column& column : columns.all) {
        glm::vec2 at = pen;
        for (const HelpLine& line : column.lines) {
            painter.draw_text(at, painter.theme()[Tone::left], line.name, factor);
            painter.draw_text({at.x + (line.name.empty() ? 0.0f : factor * column.names), at.y},
                              painter.theme()[line.is_heading ? Tone::dim : Tone::plain], line.meaning, factor);
            at.y += factor * painter.line_height();
        }
        pen.x += factor * (column.names + column.meanings + ImGui::GetFontSize());
    }
}

}  // namespace osteomill
