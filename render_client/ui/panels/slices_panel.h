// The panel of three slices through the CT, linked by a cross-hair that the mouse moves. Drawn with Dear
// ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render_client/ui/panels/overlay.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

/// Best first.
std::vector<glm::vec2> slices_panel_sizes(const PanelPainter& painter);
void draw_slices_panel(const OverlayContent& content, const PanelPlace& place);

/// Marks, in the picture of the bone, the place where the slices cross.
void draw_slices_cross(const OverlayContent& content, const PanelPainter& painter, const glm::ivec2& size_px);

}  // namespace osteomill
