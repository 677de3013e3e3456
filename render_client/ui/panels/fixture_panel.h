// The panel of virtual fixtures: each by name, how far the burr is from it, whether it acts, and a box to
// switch it while the session is paused.
#pragma once

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/panel_text.h"

namespace osteomill {

/// A line for each of the session's fixtures; empty without any.
PanelText fixture_text(const OverlayContent& content);

/// Whether boxes can be drawn: somebody is there to press them, and the server takes controls.
bool has_fixture_boxes(const OverlayContent& content);
glm::vec2 fixture_panel_size(const PanelText& text);
/// The same lines, each with its box.
void draw_fixture_panel(const OverlayContent& content, const PanelText& text, const PanelPlace& place);

}  // namespace osteomill
