// The panel of the start page (start/start_page.h): cases to choose from, a scan to import, files to choose.
// Drawn with Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>

#include "render_client/link/session_source.h"
#include "render_client/ui/panels/card_view.h"
#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/start/start_page.h"
#include "render_client/ui/view/view_settings.h"
#include "render_client/volume/gl/texture.h"

namespace osteomill {

/// Pictures on the GPU: the scan's preview, and the cases'. Needs the OpenGL context, as a Texture2D does.
struct StartPicture {
    std::optional<gl::Texture2D> texture{};
    glm::ivec2 size_px{0};
    std::uint64_t number = 0;              ///< number of the page's voxels that it has,
    glm::dvec3 slices_at_mm{0.0};          ///< where the slices in it meet,
    std::optional<double> threshold_hu{};  ///< and of the contour in it
    std::optional<glm::dvec2> drag{};      ///< where a drag began, pixels of the picture
    CardPictures of_cases{};
};

struct StartScreen {
    explicit StartScreen(StartPlaces places) : page(std::move(places)) {}

    /// Whether there is nothing else to do: no session, or one that has ended.
    bool is_due(LinkStatus status) const { return has_no_session(status) && !page.is_hidden; }
    /// Whether a person imports or looks for a file: nothing of a session shows beside that, and none that
    /// begins elsewhere takes the window.
    bool stands_alone(LinkStatus status) const { return is_due(status) && !page.shows_cases(); }
    /// Whether nothing of the last session shows: beside that, and until the bone of the next is there.
    bool hides_session(LinkStatus status) const { return stands_alone(status) || page.is_beginning(); }
    /// Whether it would be shown if the user had not hidden it.
    bool is_hidden(LinkStatus status) const { return has_no_session(status) && page.is_hidden; }

    StartPage page;
    StartPicture picture{};

  private:
    bool has_no_session(LinkStatus status) const {
        return status == LinkStatus::connecting || status == LinkStatus::finished ||
               (status == LinkStatus::lost && (page.has_served() || page.is_making_ready()));
    }
};

/// The panel's size: as large as is useful for the page's contents, within `available`.
glm::vec2 start_panel_size(const StartPage& page, const glm::vec2& available);

/// With the question whether to end the program, if it is asked; any other is of a session that is over, and
/// is dropped. `requests`: null if nobody can answer.
void draw_start_panel(StartPage& page, StartPicture& picture, const PanelPlace& place, ViewSettings& view,
                      SessionRequests* requests);

// The tour of the start page: three cards over it that explain it.

/// Draws the card that the page has reached, if any. Its buttons, Return and the arrow keys turn the cards.
/// Needs an ImGui window to be open.
void draw_tour(StartPage& page);

// Widgets that the start page's views share. Each needs an ImGui window to be open.

/// A field of `most` bytes at most.
template <std::size_t most = 64>
void text_field(const char* label, std::string& text, float width) {
    std::array<char, most> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    ImGui::SetNextItemWidth(width);
    if (ImGui::InputText(label, buffer.data(), buffer.size())) text = buffer.data();
}

inline bool button(const char* text, bool is_enabled) {
    ImGui::BeginDisabled(!is_enabled);
    const bool pressed = ImGui::Button(text);
    ImGui::EndDisabled();
    return pressed;
}

/// Height left for a list above `lines` of other widgets.
inline ImVec2 list_size(float lines) {
    return {0.0f, ImGui::GetContentRegionAvail().y - lines * ImGui::GetFrameHeightWithSpacing()};
}

inline const std::string& words_of_page(const StartPage& page) {
    return page.message().empty() ? page.link_line : page.message();
}

/// Height of the message, a line at least: little moves when one comes or goes.
inline float message_height(const StartPage& page) {
    const float room = ImGui::GetContentRegionAvail().x;
    return std::max(ImGui::CalcTextSize(words_of_page(page).c_str(), nullptr, false, room).y,
                    ImGui::GetTextLineHeight());
}

/// In a colour that is seen among the page's other words.
inline void draw_message(const StartPage& page) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_NavHighlight));
    ImGui::TextUnformatted(words_of_page(page).c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

}  // namespace osteomill
