// The panel that edits the transfer function: presets, and a field of points with CT numbers to the right and
// opacity upwards over the colours that they give.
#pragma once

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/view/view_settings.h"

namespace osteomill {

glm::vec2 transfer_panel_size(const PanelPainter& painter);
void draw_transfer_panel(const PanelPainter& painter, ViewSettings& view, const PanelPlace& place);

}  // namespace osteomill
