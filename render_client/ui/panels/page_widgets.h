// Widgets that the start page's views share. Each needs an ImGui window to be open.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "render_client/ui/start/start_page.h"

namespace osteomill {

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

inline const std::string& words_below(const StartPage& page) {
    return page.message().empty() ? page.link_line : page.message();
}

/// Room that the message takes beyond its first line, in lines of widgets.
inline float more_message_lines(const StartPage& page) {
    const float room = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::CalcTextSize(words_below(page).c_str(), nullptr, false, room).y;
    return std::max(0.0f, height - ImGui::GetTextLineHeight()) / ImGui::GetFrameHeightWithSpacing();
}

inline void draw_message(const StartPage& page) {
    const bool is_of_link = page.message().empty();
    ImGui::PushTextWrapPos(0.0f);
    if (is_of_link) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_NavHighlight));
    ImGui::TextUnformatted(words_below(page).c_str());
    if (is_of_link) ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

}  // namespace osteomill
