// The panel of virtual fixtures: each by name, how far the burr is from it, whether it acts, and a box to
// switch it while the session is paused.
#pragma once

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/panel_text.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/volume/camera.h"

namespace osteomill {

/// A line for each of the session's fixtures; empty without any.
PanelText fixture_text(const SeenSession& session);

glm::vec2 fixture_panel_size(const PanelText& text);
/// The same lines, each with its box; a pressed one goes into `requests`.
void draw_fixture_panel(const SeenSession& session, const Theme& theme, const PanelText& text,
                        const PanelPlace& place, SessionRequests& requests);

// Guides of virtual fixtures as lines over the picture: they are information, not things, and bone does not
// hide them. A line with its ends, a tube with a ring at each end, a plane with a ring under the burr; and a
// line from the burr to each guide that acts.

/// The place of a guide's path that is nearest to the burr's centre.
glm::dvec3 nearest_of_path(const Fixture& guide, const glm::dvec3& burr_mm);

/// Marks the guides of the session that are on; the session has a tool.
void draw_guides(const PanelPainter& painter, const SeenSession& session, const Camera& camera,
                 const glm::ivec2& size_px);

}  // namespace osteomill
