#include "render_client/ui/panels/sight_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "common/words/translation.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

constexpr float widest_letters = 34.0f;

std::string advice_of_own_session() {
    return tr(
        "Hold still: it goes on by itself. If it does not, break the session off, and start anew: what was "
        "recorded is kept.");
}

std::string percent_received(const LinkUpdate& link) {
    if (link.snapshot_bricks_total == 0) return tr("The bone is on its way");
    return trf("The bone is on its way: {} %",
               std::uint64_t{100} * link.snapshot_bricks / link.snapshot_bricks_total);
}

/// So that a line may be as long as a status line is.
float height_of(const std::string& text, float width) {
    return text.empty()
               ? 0.0f
               : ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + ImGui::GetStyle().ItemSpacing.y;
}

}  // namespace

std::string advice_before_first_answer() {
    return tr(
        "This window joins as soon as it answers. See whether the server runs, and whether the address is "
        "right.");
}

SightWords words_without_session() {
    return {tr("No session runs"), {}, tr("A case is started, and a saved session opened, among the cases.")};
}

SightWords words_of_sight(const SeenSession& session, std::optional<int> preparation_percent, bool is_own) {
    const LinkUpdate& link = session.link;
    switch (session.sight) {
        case SessionSight::none:
            return {tr("No server has answered yet"), link.status_line, advice_before_first_answer()};
        case SessionSight::coming:
            return {percent_received(link), link.status_line, {}};
        case SessionSight::preparing:
            return {preparation_percent ? trf("Preparing the bone: {} %", *preparation_percent)
                                        : tr("Preparing the bone"),
                    {},
                    tr("Nothing acts before it is there.")};
        case SessionSight::silent:
            return {
                tr("The server is silent"),
                tr("What you see is of before: how the tool is now is not known."),
                is_own
                    ? advice_of_own_session()
                    : tr("Hold still: it goes on by itself. If it does not, see whether the server's machine "
                         "runs and the network cable is in.")};
        case SessionSight::lost:
            if (link.status == LinkStatus::refused)
                return {tr("The server does not take this window"), link.status_line,
                        tr("Show this to whoever looks after the simulator.")};
            return {tr("The link to the server is lost"), link.status_line,
                    is_own
                        ? advice_of_own_session()
                        : tr("What you see is of before. This window joins again by itself. If it does not, "
                             "see whether the server runs and the network cable is in. What was recorded "
                             "until now is kept.")};
        case SessionSight::now:
        case SessionSight::over:
            break;
    }
    return {};
}

glm::vec2 sight_panel_size(const SightWords& words, bool has_buttons, const glm::vec2& available) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const glm::vec2 padding(2.0f * style.WindowPadding.x, 2.0f * style.WindowPadding.y);
    const float width = std::min(widest_letters * ImGui::GetFontSize(), available.x - padding.x);
    float height = 0.0f;
    for (const std::string& text : {words.title, words.cause, words.advice}) height += height_of(text, width);
    if (has_buttons) height += ImGui::GetFrameHeightWithSpacing();
    return {width + padding.x, height + padding.y};
}

void draw_sight_panel(const SightWords& words, const std::optional<SightButtons>& buttons,
                      const PanelPlace& place) {
    const WidgetPanel window("sight", place);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_NavHighlight));
    ImGui::TextUnformatted(words.title.c_str());
    ImGui::PopStyleColor();
    for (const std::string& text : {words.cause, words.advice})
        if (!text.empty()) ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (!buttons) return;
    if (buttons->break_off) {
        if (ImGui::Button(tr("Break it off"))) buttons->page->break_off();
        return;
    }
    if (buttons->page != nullptr) {
        if (ImGui::Button(tr("Back to the cases"))) buttons->page->is_hidden = false;
        ImGui::SameLine();
    }
    if (ImGui::Button(tr("End"))) buttons->requests.ends_program = true;
}

}  // namespace osteomill
