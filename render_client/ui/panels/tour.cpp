#include "render_client/ui/panels/tour.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"

namespace osteomill {

namespace {

struct TourCard {
    std::string title, text;
};

std::array<TourCard, 3> cards() {
    return {{{tr("1 of 3: choose a case"),
              tr("Each card is a piece of bone with a task. Click on one, or go there with the arrow keys; a "
                 "second click, or RETURN, starts it.\n\n"
                 "A CT of your own becomes a card by Import a scan ...")},
             {tr("2 of 3: drill"),
              trf("Drag with the left mouse button: the burr goes over the bone. Hold SPACE: it turns. The "
                  "wheel, or W, pushes it into the bone, S pulls it out.\n\n"
                  "Near what is protected a banner and a frame warn. {} undoes a stroke. {} shows all keys.",
                  key_of(Action::undo), key_of(Action::help))},
             {tr("3 of 3: read the report"),
              trf("Finish, or {}, ends the session. Its report says how long it took, with which forces, "
                  "what was removed and what was touched.\n\n"
                  "It stays under Sessions so far. Compare all sessions draws learning curves.",
                  key_of(Action::finish))}}};
}

bool is_pressed(ImGuiKey key) {
    return !ImGui::IsAnyItemFocused() && ImGui::IsKeyPressed(key, false);
}

void draw_card(StartPage& page) {
    const std::size_t number = *page.tour_card;
    const bool is_last = number + 1 == cards().size();
    ImGui::TextUnformatted(cards()[number].title.c_str());
    ImGui::Separator();
    ImGui::TextWrapped("%s", cards()[number].text.c_str());
    ImGui::SetCursorPosY(ImGui::GetWindowHeight() - ImGui::GetFrameHeight() -
                         ImGui::GetStyle().WindowPadding.y);
    if (ImGui::Button(is_last ? tr("Begin") : tr("Next")) || is_pressed(ImGuiKey_Enter) ||
        is_pressed(ImGuiKey_RightArrow))
        is_last ? page.tour_card.reset() : void(page.tour_card = number + 1);
    ImGui::SameLine();
    ImGui::BeginDisabled(number == 0);
    if (ImGui::Button(tr("Back")) || (number > 0 && is_pressed(ImGuiKey_LeftArrow)))
        page.tour_card = number - 1;
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button(tr("Skip"))) page.tour_card.reset();
    ImGui::SameLine();
    ImGui::TextDisabled("%s", trf("RETURN: on   {}: skip", key_of(Action::end)).c_str());
}

/// Opaque, for the page is not to be read through it. ImGui would put a child's own background below the
/// children before the last.
void draw_paper() {
    const ImVec2 low = ImGui::GetWindowPos();
    const ImVec2 high{low.x + ImGui::GetWindowWidth(), low.y + ImGui::GetWindowHeight()};
    ImVec4 paper = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    paper.w = 1.0f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(low, high);
    list.AddRectFilled(low, high, ImGui::GetColorU32(paper));
    list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_NavHighlight));
    list.PopClipRect();
}

}  // namespace

void draw_tour(StartPage& page) {
    if (!page.tour_card) return;
    const float letter = ImGui::GetFontSize();
    const ImVec2 room = ImGui::GetWindowSize();
    const ImVec2 size{std::min(36.0f * letter, 0.9f * room.x),
                      7.0f * letter + 3.0f * ImGui::GetFrameHeightWithSpacing()};
    ImGui::SetCursorPos({0.5f * (room.x - size.x), 0.5f * (room.y - size.y)});
    ImGui::BeginChild("tour", size, false,
                      ImGuiWindowFlags_NavFlattened | ImGuiWindowFlags_AlwaysUseWindowPadding);
    draw_paper();
    draw_card(page);
    ImGui::EndChild();
}

}  // namespace osteomill
