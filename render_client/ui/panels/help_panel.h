// The help that F1 shows, printed from the table of key bindings, in as many columns as keep its letters largest in the picture.
#pragma once

#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

/// Size of its letters in that room, as a share of the usual.
float help_letters(const PanelPainter& painter, Situation situation, const glm::vec2& room);
/// At most `room` large.
glm::vec2 help_size(const PanelPainter& painter, Situation situation, const glm::vec2& room);
void draw_help(const PanelPainter& painter, Situation situation, const PanelPlace& place);

}  // namespace osteomill
