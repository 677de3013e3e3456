// A legend of the tissues: colours, and which of them the burr must not touch.
#pragma once

#include <span>

#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

glm::vec2 legend_size(const PanelPainter& painter, std::span<const Tissue> tissues);
void draw_legend(const PanelPainter& painter, std::span<const Tissue> tissues, const PanelPlace& place);

}  // namespace osteomill
