// The panel that edits the transfer function: presets, and a field of points with stiffness to the right and
// opacity upwards over the colours that they give.
#pragma once

#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

glm::vec2 transfer_panel_size(const PanelPainter& painter);
void draw_transfer_panel(const PanelPainter& painter, TransferEditor& editor, const PanelPlace& place);

}  // namespace osteomill
