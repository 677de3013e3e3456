// The start page's view of an import: the scan's slices, the region in them, and the choices for it.
#pragma once

#include "render_client/ui/panels/start_panel.h"

namespace osteomill {

/// Needs an ImGui window to be open.
void draw_import(StartPage& page, StartPicture& picture);

}  // namespace osteomill
