// The tool bar: buttons for all controls of the session, with labels, signs and keys. Drawn with Dear ImGui;
// needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render_client/ui/input/session_requests.h"
#include "render_client/ui/panels/overlay.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

/// Whether there is a session that can be controlled, by this client or another.
bool has_tool_bar(const OverlayContent& content);

/// With labels, with signs alone, and only the most used signs.
std::vector<glm::vec2> tool_bar_sizes(const OverlayContent& content, const PanelPainter& painter);
/// Pressed buttons set content.requests and content.view.
void draw_tool_bar(const OverlayContent& content, const PanelPlace& place);

}  // namespace osteomill
