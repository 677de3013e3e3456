// A card on the start page: a case's picture, name, a sentence about it and its protected structures.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "render_client/ui/start/start_page.h"
#include "render_client/volume/gl/texture.h"

namespace osteomill {

/// Pictures of cases on the GPU. Needs the OpenGL context, as a Texture2D does.
class CardPictures {
  public:
    /// A built-in case's picture is the program's own, another's is picture.png in its folder; null if there
    /// is none.
    const gl::Texture2D* of(const ShelvedCase& shelved);

  private:
    std::map<std::string, std::optional<gl::Texture2D>> held_;  // by its name for --case
};

/// Height at which each card of the page shows its whole text, for cards of that width; at most twelve
/// letters' heights.
float case_card_height(const StartPage& page, float width);

/// Draws the card of page.cases()[index]. A click, or Return, chooses it; another starts it. Needs an ImGui
/// window to be open.
void draw_case_card(StartPage& page, CardPictures& pictures, std::size_t index, const ImVec2& size);

}  // namespace osteomill
