// The panel in the middle while the picture does not show the session as it is now: the cause and the remedy,
// worded for a trainee. Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/overlay.h"

namespace osteomill {

struct SightWords {
    std::string title;
    std::string cause;   ///< may be empty
    std::string advice;  ///< may be empty
};

/// The text for a sight that has one.
SightWords words_of_sight(const OverlayContent& content);

glm::vec2 sight_panel_size(const OverlayContent& content, const glm::vec2& available);
/// With buttons to end, and to go back to the page of cases, while no server has answered.
void draw_sight_panel(const OverlayContent& content, const PanelPlace& place);

}  // namespace osteomill
