// A panel of Dear ImGui that takes input, at a place that the layout gave it.
#pragma once

#include <imgui.h>

#include "render_client/ui/panels/layout.h"

namespace osteomill {

/// Open for widgets as long as it lives.
class InputPanel {
  public:
    enum class Background { filled, none };

    InputPanel(const char* name, const PanelPlace& place, Background background = Background::filled) {
        ImGui::SetNextWindowPos({place.first.x, place.first.y}, ImGuiCond_Always);
        ImGui::SetNextWindowSize({place.size.x, place.size.y}, ImGuiCond_Always);
        ImGui::Begin(name, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav |
                         (background == Background::none ? ImGuiWindowFlags_NoBackground : 0));
    }
    ~InputPanel() { ImGui::End(); }
    InputPanel(const InputPanel&) = delete;
    InputPanel& operator=(const InputPanel&) = delete;
};

}  // namespace osteomill
