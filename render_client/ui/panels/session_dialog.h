// The dialog in the middle of the picture: the text of a mark, and confirmation of reset, finish and end.
// Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/view_settings.h"

namespace osteomill {

/// The size of the dialog for view.question, which must be set. `started_session`: this program runs a
/// session, which ends with it.
glm::vec2 session_dialog_size(const ViewSettings& view, bool started_session);
/// An answer goes into `requests` and ends the question.
void draw_session_dialog(ViewSettings& view, bool started_session, const PanelPlace& place,
                         SessionRequests& requests);

}  // namespace osteomill
