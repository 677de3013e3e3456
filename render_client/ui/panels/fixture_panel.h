// The panel of virtual fixtures: each by name, how far the burr is from it, whether it acts, and a box to
// switch it while the session is paused.
#pragma once

#include "render_client/ui/input/session_requests.h"
#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/panel_text.h"

namespace osteomill {

/// A line for each of the session's fixtures; empty without any.
PanelText fixture_text(const SeenSession& session);

glm::vec2 fixture_panel_size(const PanelText& text);
/// The same lines, each with its box; a pressed one goes into `requests`.
void draw_fixture_panel(const SeenSession& session, const Theme& theme, const PanelText& text,
                        const PanelPlace& place, SessionRequests& requests);

}  // namespace osteomill
