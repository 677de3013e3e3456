// The dialog in the middle of the picture: the text of a mark, and confirmation of reset, finish and end.
// Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/view_settings.h"

namespace osteomill {

/// The session that is there while a question is asked: one that this program runs, and that ends with it, or
/// one that others are in, too.
enum class SessionAtHand { none, own, of_others };

/// The size of the dialog for view.question, which must be set.
glm::vec2 session_dialog_size(const ViewSettings& view, SessionAtHand session);
/// An answer goes into `requests` and ends the question.
void draw_session_dialog(ViewSettings& view, SessionAtHand session, const PanelPlace& place,
                         SessionRequests& requests);
/// Its contents, in the ImGui window that is open.
void draw_question(ViewSettings& view, SessionAtHand session, SessionRequests& requests);

}  // namespace osteomill
