// The dialog in the middle of the picture: the text of a mark, and confirmation of reset, finish and end.
// Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include "render_client/ui/panels/overlay.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

/// The size of the dialog for content.view->question, which must be set.
glm::vec2 session_dialog_size(const OverlayContent& content, const PanelPainter& painter);
/// An answer goes into content.requests and ends the question.
void draw_session_dialog(const OverlayContent& content, const PanelPlace& place);

}  // namespace osteomill
