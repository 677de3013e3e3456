// The panel of the second, small view (inset_view.h).
#pragma once

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/view/inset_view.h"

namespace osteomill {

/// Its edge in a picture of this size: less than a third of the lesser side.
int inset_edge_px(const glm::vec2& picture);
/// The left upper corner, or the right one if the burr, seen at this pixel (y down), is near the left.
Anchor inset_anchor(const glm::dvec2& burr_px, const glm::vec2& picture);
void draw_inset(const PanelPainter& painter, const gl::Framebuffer& inset, InsetKind kind,
                double burr_diameter_mm, const PanelPlace& place);

}  // namespace osteomill
