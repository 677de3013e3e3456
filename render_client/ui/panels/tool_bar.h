// The tool bar: buttons for all controls of the session, with labels, signs and keys. Drawn with Dear ImGui;
// needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/view_settings.h"

namespace osteomill {

/// With labels, with signs alone, and only the most used signs.
std::vector<glm::vec2> tool_bar_sizes(const SeenSession& session, const ViewSettings& view);
/// For a session that takes controls. Pressed buttons set `requests` and `view`.
void draw_tool_bar(const SeenSession& session, ViewSettings& view, const PanelPlace& place,
                   SessionRequests& requests);

}  // namespace osteomill
