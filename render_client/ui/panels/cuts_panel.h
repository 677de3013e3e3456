// The panel that sets the cuts through the bone.
#pragma once

#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

glm::vec2 cuts_panel_size(const PanelPainter& painter);
/// A cut that is switched on faces `camera`.
void draw_cuts_panel(CutSettings& cuts, const Camera& camera, const PanelPlace& place);

}  // namespace osteomill
