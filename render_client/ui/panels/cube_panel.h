// The orientation cube over the picture; a click on a face turns the view to it.
#pragma once

#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

glm::vec2 cube_size(const PanelPainter& painter);
void draw_cube(const PanelPainter& painter, Camera& camera, const PanelPlace& place);

}  // namespace osteomill
