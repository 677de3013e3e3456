// Texts about protected structures: the distance of the nearest, and the touched ones.
#pragma once

#include "render_client/ui/panels/panel_text.h"

namespace osteomill {

/// The nearest by name with its distance, and every structure that was touched, for as long as the session
/// lasts; empty if the session protects nothing.
PanelText structure_text(const SeenSession& session);
/// Those that the burr touches or is within the warning distance of; mostly none.
PanelText structure_warnings(const SeenSession& session);

}  // namespace osteomill
