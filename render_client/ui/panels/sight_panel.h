// The panel in the middle while the picture does not show the session as it is now: the cause and the remedy,
// worded for a trainee. Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/start/start_page.h"

namespace osteomill {

struct SightWords {
    std::string title;
    std::string cause;   ///< may be empty
    std::string advice;  ///< may be empty
};

/// Where no server has answered.
std::string advice_before_first_answer();
/// The text where no session runs, and the start page is hidden.
SightWords words_without_session();
/// The text for a sight that has one. `preparation_percent`: of the bone's textures, as far as known;
/// `is_own`: this window started the session.
SightWords words_of_sight(const SeenSession& session, std::optional<int> preparation_percent,
                          bool is_own = false);

/// Buttons to end the program and to go back to the page of cases; or to break a session off.
struct SightButtons {
    SessionRequests& requests;
    StartPage* page = nullptr;  ///< null if no session is started from here
    bool break_off = false;     ///< its program stands still; `page` is not null
};
/// `buttons`: nothing if nobody can press them, or none are needed.
glm::vec2 sight_panel_size(const SightWords& words, bool has_buttons, const glm::vec2& available);
void draw_sight_panel(const SightWords& words, const std::optional<SightButtons>& buttons,
                      const PanelPlace& place);

}  // namespace osteomill
