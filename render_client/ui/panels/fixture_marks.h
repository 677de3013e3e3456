// Guides of virtual fixtures as lines over the picture: they are information, not things, and bone does not
// hide them. A line with its ends, a tube with a ring at each end, a plane with a ring under the burr; and a
// line from the burr to each guide that acts.
#pragma once

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/volume/camera.h"

namespace osteomill {

/// The place of a guide's path that is nearest to the burr's centre.
glm::dvec3 nearest_of_path(const Fixture& guide, const glm::dvec3& burr_mm);

/// Marks the guides of the session that are on; the session has a tool.
void draw_guides(const PanelPainter& painter, const SeenSession& session, const Camera& camera,
                 const glm::ivec2& size_px);

}  // namespace osteomill
