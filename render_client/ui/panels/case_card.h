// A card on the start page: a case's picture, name, a sentence about it and what is protected in it.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "render_client/ui/start/start_page.h"
#include "render_client/volume/gl/picture_texture.h"

namespace osteomill {

/// Pictures of cases on the GPU. Needs the OpenGL context, as a PictureTexture does.
class CardPictures {
  public:
    /// The program's own of a built-in case, else picture.png in the case's folder; null where there is none.
    const gl::PictureTexture* of(const ShelvedCase& shelved);

  private:
    std::map<std::string, std::optional<gl::PictureTexture>> held_;  // by what --case takes
};

/// Of page.cases()[index]. A click, or Return, chooses it; another starts it. Needs an ImGui window to be
/// open.
void draw_case_card(StartPage& page, CardPictures& pictures, std::size_t index, const ImVec2& size);

}  // namespace osteomill
