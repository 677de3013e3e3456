// A panel of Dear ImGui that takes input, at a place that the layout gave it.
#pragma once

#include <imgui.h>

#include "render_client/ui/panels/layout.h"

namespace osteomill {

/// Open for widgets as long as it lives.
class WidgetPanel {
  public:
    enum class Background { filled, none };

    /// In a place smaller than its full size it scrolls.
    enum class Size { whole, scrolls };

    /// A page has the keyboard: Tab and arrows go from widget to widget, Return presses one.
    enum class Keys { none, reach_it };

    WidgetPanel(const char* name, const PanelPlace& place, Background background = Background::filled,
                Size size = Size::whole, Keys keys = Keys::none) {
        ImGui::SetNextWindowPos({place.first.x, place.first.y}, ImGuiCond_Always);
        ImGui::SetNextWindowSize({place.size.x, place.size.y}, ImGuiCond_Always);
        ImGui::Begin(
            name, nullptr,
            (size == Size::whole ? ImGuiWindowFlags_NoDecoration
                                 : ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_HorizontalScrollbar) |
                ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                (keys == Keys::none ? ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav : 0) |
                (background == Background::none ? ImGuiWindowFlags_NoBackground : 0));
    }
    ~WidgetPanel() { ImGui::End(); }
    WidgetPanel(const WidgetPanel&) = delete;
    WidgetPanel& operator=(const WidgetPanel&) = delete;
};

}  // namespace osteomill
