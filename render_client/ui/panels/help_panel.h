// The help that F1 shows, printed from the table of key bindings, in as many columns as keep its letters
// largest in the picture.
#pragma once

#include <cstddef>
#include <vector>

#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

struct HelpColumn {
    std::size_t rows = 0;
    float names = 0.0f, meanings = 0.0f;  ///< widths, px at the usual size of letters
};

struct HelpLayout {
    std::vector<HelpLine> lines;  ///< column by column
    std::vector<HelpColumn> columns;
    glm::vec2 size{0.0f};  ///< of the panel, px
    float letters = 1.0f;  ///< their size, as a share of the usual
};

/// The layout with the largest letters that fits `room`.
HelpLayout lay_out_help(const PanelPainter& painter, Situation situation, const glm::vec2& room);
void draw_help(const PanelPainter& painter, const HelpLayout& help, const PanelPlace& place);

}  // namespace osteomill
