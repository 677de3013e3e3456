// The tour of the start page: three cards over it that explain it.
#pragma once

#include "render_client/ui/start/start_page.h"

namespace osteomill {

/// The card that the page is at, if it is at one: buttons, Return and the arrow keys go on and back. Needs an
/// ImGui window to be open.
void draw_tour(StartPage& page);

}  // namespace osteomill
