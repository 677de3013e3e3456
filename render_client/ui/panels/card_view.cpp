#include "render_client/ui/panels/card_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "common/words/translation.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/start/case_library.h"
#include "render_client/volume/picture.h"

namespace osteomill {

namespace {

/// Nothing if no picture can be read: the card is then drawn without one.
std::optional<Picture> picture_of(const ShelvedCase& shelved) {
    try {
        if (shelved.is_built_in) {
            const auto shipped = std::ranges::find(case_pictures(), shelved.name, &CasePicture::name);
            if (shipped != case_pictures().end()) return read_png(shipped->png);
        }
        return read_png(std::filesystem::path(shelved.argument) / "picture.png");
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

constexpr float between_texts = 2.0f;

float gap_in_card() {
    return 0.5f * ImGui::GetFontSize();
}

/// It has the height of a card with little text, however high the other cards are.
ImVec2 picture_in_card() {
    const float height = 7.6f * ImGui::GetFontSize() - 2.0f * gap_in_card();
    return {1.4f * height, 1.4f / 1.5f * height};
}

float text_width_of_card(float width) {
    return width - picture_in_card().x - 3.0f * gap_in_card();
}

struct CardText {
    std::string text;
    ImGuiCol colour;
};

std::vector<CardText> texts_of(const ShelvedCase& shelved) {
    std::vector<CardText> texts{
        {shelved.is_built_in ? tr(shelved.name.c_str()) : shelved.name, ImGuiCol_Text},
        {tr(shelved.description.c_str()), ImGuiCol_TextDisabled}};
    if (!shelved.protected_names.empty())
        texts.push_back({trf("protected: {}", shelved.protected_names), ImGuiCol_Text});
    return texts;
}

float height_in_card(const std::string& text, float width) {
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + between_texts;
}

}  // namespace

float case_card_height(const StartPage& page, float width) {
    float height = picture_in_card().y;
    for (const ShelvedCase& shelved : page.cases()) {
        float of_texts = 0.0f;
        for (const CardText& text : texts_of(shelved))
            of_texts += height_in_card(text.text, text_width_of_card(width));
        height = std::max(height, of_texts);
    }
    const float letter = ImGui::GetFontSize();
    return std::clamp(height + 2.0f * gap_in_card(), 7.6f * letter, 12.0f * letter);
}

void draw_case_card(StartPage& page, CardPictures& pictures, std::size_t index, const ImVec2& size) {
    const ShelvedCase& shelved = page.cases()[index];
    const float gap = gap_in_card();
    const ImVec2 first = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(index));
    const bool is_chosen = page.chosen == index;
    // The chosen card is filled; the one under the pointer only has a brighter edge.
    if (!is_chosen) ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImVec4());
    if (ImGui::Selectable("##card", is_chosen, ImGuiSelectableFlags_AllowDoubleClick, size)) {
        const ImGuiIO& io = ImGui::GetIO();
        const bool by_mouse = io.MouseDown[ImGuiMouseButton_Left] || io.MouseReleased[ImGuiMouseButton_Left];
        page.chosen = index;
        if (by_mouse)
            page.click_card(index);
        else if (is_chosen && page.may_start())
            page.start();
    }
    const bool is_hovered = ImGui::IsItemHovered();
    if (!is_chosen) ImGui::PopStyleColor();
    if (is_chosen) ImGui::SetItemDefaultFocus();
    if (is_chosen && std::exchange(page.scrolls_to_chosen, false)) ImGui::SetScrollHereY();
    ImGui::PopID();
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImGuiCol edge = is_chosen ? ImGuiCol_Text : is_hovered ? ImGuiCol_TextDisabled : ImGuiCol_Border;
    canvas.AddRect(first, {first.x + size.x, first.y + size.y}, ImGui::GetColorU32(edge), 3.0f, 0,
                   is_chosen ? 2.0f : 1.0f);
    const ImVec2 picture_size = picture_in_card();
    const ImVec2 inner{first.x + gap, first.y + gap};
    canvas.PushClipRect(first, {first.x + size.x, first.y + size.y}, true);
    if (const gl::Texture2D* picture = pictures.of(shelved))
        canvas.AddImageRounded(texture_of(picture->id()), inner,
                               {inner.x + picture_size.x, inner.y + picture_size.y}, {0, 0}, {1, 1},
                               IM_COL32_WHITE, 3.0f);
    const float width = text_width_of_card(size.x);
    ImVec2 at{inner.x + picture_size.x + gap, inner.y};
    for (const CardText& text : texts_of(shelved)) {
        canvas.AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, ImGui::GetColorU32(text.colour),
                       text.text.c_str(), nullptr, width);
        at.y += height_in_card(text.text, width);
    }
    canvas.PopClipRect();
}

const gl::Texture2D* CardPictures::of(const ShelvedCase& shelved) {
    const auto [held, is_new] = held_.try_emplace(shelved.argument);
    if (is_new)
        if (const auto picture = picture_of(shelved)) held->second.emplace().upload(*picture);
    return held->second ? &*held->second : nullptr;
}

}  // namespace osteomill
