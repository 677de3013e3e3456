// The tour of the start page: three cards over it that explain it.
#pragma once

#include "render_client/ui/start/start_page.h"

namespace osteomill {

/// Draws the card that the page has reached, if any. Its buttons, Return and the arrow keys turn the cards.
/// Needs an ImGui window to be open.
void draw_tour(StartPage& page);

}  // namespace osteomill
