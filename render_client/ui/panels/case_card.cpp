#include "render_client/ui/panels/case_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>

#include "common/words/translation.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/start/case_pictures.h"
#include "render_client/volume/png_file.h"

namespace osteomill {

namespace {

/// Nothing if there is none that can be read: a card without a picture is a card.
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

/// Text that is cut off below `end_y`; returns where the next line goes.
float write_in_card(const char* text, const ImVec2& at, float width, float end_y, ImU32 colour) {
    const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, width);
    if (at.y + ImGui::GetFontSize() > end_y) return end_y;
    ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, colour, text, nullptr,
                                        width);
    return at.y + size.y + 2.0f;
}

}  // namespace

void draw_case_card(StartPage& page, CardPictures& pictures, std::size_t index, const ImVec2& size) {
    const ShelvedCase& shelved = page.cases()[index];
    const float gap = 0.5f * ImGui::GetFontSize();
    const ImVec2 first = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(index));
    const bool is_chosen = page.chosen == index;
    if (ImGui::Selectable("##card", is_chosen, ImGuiSelectableFlags_AllowDoubleClick, size)) {
        const ImGuiIO& io = ImGui::GetIO();
        const bool by_mouse = io.MouseDown[ImGuiMouseButton_Left] || io.MouseReleased[ImGuiMouseButton_Left];
        const bool starts = by_mouse ? ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) : is_chosen;
        page.chosen = index;
        if (starts && !page.is_session_running()) page.start();
    }
    if (is_chosen) ImGui::SetItemDefaultFocus();
    ImGui::PopID();
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddRect(first, {first.x + size.x, first.y + size.y}, ImGui::GetColorU32(ImGuiCol_Border), 3.0f);
    const ImVec2 picture_size{1.4f * (size.y - 2.0f * gap), 1.4f / 1.5f * (size.y - 2.0f * gap)};
    const ImVec2 inner{first.x + gap, first.y + gap};
    if (const gl::Texture2D* picture = pictures.of(shelved))
        canvas.AddImageRounded(texture_of(picture->id()), inner,
                               {inner.x + picture_size.x, inner.y + picture_size.y}, {0, 0}, {1, 1},
                               IM_COL32_WHITE, 3.0f);
    const float left = inner.x + picture_size.x + gap;
    const float width = first.x + size.x - gap - left;
    const float end_y = first.y + size.y;
    const ImU32 plain = ImGui::GetColorU32(ImGuiCol_Text);
    float y = write_in_card(shelved.is_built_in ? tr(shelved.name.c_str()) : shelved.name.c_str(),
                            {left, inner.y}, width, end_y, plain);
    y = write_in_card(tr(shelved.description.c_str()), {left, y}, width, end_y,
                      ImGui::GetColorU32(ImGuiCol_TextDisabled));
    if (!shelved.protected_names.empty())
        write_in_card(trf("protected: {}", shelved.protected_names).c_str(), {left, y}, width, end_y, plain);
}

const gl::Texture2D* CardPictures::of(const ShelvedCase& shelved) {
    const auto [held, is_new] = held_.try_emplace(shelved.argument);
    if (is_new)
        if (const auto picture = picture_of(shelved)) held->second.emplace().upload(*picture);
    return held->second ? &*held->second : nullptr;
}

}  // namespace osteomill
