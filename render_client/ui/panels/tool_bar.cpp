#include "render_client/ui/panels/tool_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "render_client/ui/panels/input_panel.h"

namespace osteomill {

namespace {

enum class Tool { pedal, burr, tilt, place, slices, undo, redo, reset, pause, mark, save, finish };

struct ToolButton {
    Tool tool;
    std::string sign;
    std::string word;
    std::string tip;
    bool is_enabled = true;
    bool is_on = false;
};

std::string burr_words(const Burr& burr) {
    return burr.is_ball()
               ? fmt::format("{:.1f} mm", burr.diameter_mm)
               : fmt::format("{} {:.1f} mm", head_shape_names[static_cast<std::size_t>(burr.head.shape)],
                             burr.diameter_mm);
}

std::vector<ToolButton> buttons(const OverlayContent& content) {
    const SessionStatus& can = content.link.controls;
    const bool may = can.may_control;
    std::vector<ToolButton> buttons;
    if (content.operator_command) {
        const OperatorCommand& command = *content.operator_command;
        buttons.push_back({.tool = Tool::pedal,
                           .sign = "\u25CF",
                           .word = "Pedal",
                           .tip = "the spindle turns until you press again, or while SPACE is held",
                           .is_enabled = may && !can.is_paused,
                           .is_on = command.pedal});
        if (content.session && command.burr < content.session->burrs.size())
            buttons.push_back({.tool = Tool::burr,
                               .sign = "\u25CE",
                               .word = burr_words(content.session->burrs[command.burr]),
                               .tip = "choose a burr (1 to 9, [ ])",
                               .is_enabled = may});
        buttons.push_back({.tool = Tool::tilt,
                           .sign = "\u2197",
                           .word = "Tilt",
                           .tip = "left drag tilts the handpiece (T); the arrow keys do, too",
                           .is_enabled = may,
                           .is_on = content.view->drag_tilts});
    }
    buttons.push_back({.tool = Tool::place,
                       .sign = "\u2316",
                       .word = "Place",
                       .tip = "then click on bone: there the tool goes, the handpiece upright on it (L)",
                       .is_enabled = may,
                       .is_on = content.view->click_places});
    if (content.session != nullptr && content.session->has_ct)
        buttons.push_back({.tool = Tool::slices,
                           .sign = "\u25A6",
                           .word = "CT",
                           .tip = "slices of the CT (F7)",
                           .is_on = content.view->slices_shown});
    const auto counted = [](const char* word, std::uint32_t count) {
        return count > 0 ? fmt::format("{} {}", word, count) : std::string(word);
    };
    buttons.push_back({.tool = Tool::undo,
                       .sign = "\u21B6",
                       .word = counted("Undo", can.undo_steps),
                       .tip = "gives back what the last stroke took (U)",
                       .is_enabled = may && can.undo_steps > 0});
    buttons.push_back({.tool = Tool::redo,
                       .sign = "\u21B7",
                       .word = counted("Redo", can.redo_steps),
                       .tip = "the stroke that was undone last (R)",
                       .is_enabled = may && can.redo_steps > 0});
    buttons.push_back({.tool = Tool::reset,
                       .sign = "\u21BA",
                       .word = "Reset",
                       .tip = "undoes all strokes",
                       .is_enabled = may && can.undo_steps > 0});
    buttons.push_back({.tool = Tool::pause,
                       .sign = can.is_paused ? "\u25B6" : "\u275A\u275A",
                       .word = can.is_paused ? "Go on" : "Pause",
                       .tip = "force and spindle off (H)",
                       .is_enabled = may,
                       .is_on = can.is_paused});
    buttons.push_back({.tool = Tool::mark,
                       .sign = "\u2691",
                       .word = "Mark",
                       .tip = "this moment, with a note, for the report (M)",
                       .is_enabled = may});
    buttons.push_back({.tool = Tool::save,
                       .sign = "\u21E9",
                       .word = "Save",
                       .tip = "the bone as it is, where the server saves it (F6)",
                       .is_enabled = may});
    buttons.push_back({.tool = Tool::finish,
                       .sign = "\u25A0",
                       .word = "Finish",
                       .tip = "ends the session for everybody; all is saved (F10)",
                       .is_enabled = may});
    return buttons;
}

std::string text_of(const ToolButton& button, bool has_words) {
    return has_words ? button.sign + " " + button.word : button.sign;
}

glm::vec2 size_of(const std::vector<ToolButton>& buttons, bool has_words) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 2.0f * style.WindowPadding.x - style.ItemSpacing.x;
    for (const ToolButton& button : buttons)
        width += ImGui::CalcTextSize(text_of(button, has_words).c_str()).x + 2.0f * style.FramePadding.x +
                 style.ItemSpacing.x;
    return {std::ceil(width), ImGui::GetFrameHeight() + 2.0f * style.WindowPadding.y};
}

void press(Tool tool, const OverlayContent& content) {
    SessionWishes& wishes = *content.wishes;
    switch (tool) {
        case Tool::pedal:
            wishes.switches_pedal = true;
            break;
        case Tool::burr:
            ImGui::OpenPopup("burrs");
            break;
        case Tool::tilt:
            content.view->drag_tilts = !content.view->drag_tilts;
            break;
        case Tool::place:
            content.view->click_places = !content.view->click_places;
            break;
        case Tool::slices:
            content.view->slices_shown = !content.view->slices_shown;
            break;
        case Tool::undo:
            wishes.controls.push_back({SessionAction::undo});
            break;
        case Tool::redo:
            wishes.controls.push_back({SessionAction::redo});
            break;
        case Tool::reset:
            content.view->question = SessionQuestion::reset;
            break;
        case Tool::pause:
            wishes.controls.push_back(
                {content.link.controls.is_paused ? SessionAction::resume : SessionAction::pause});
            break;
        case Tool::mark:
            content.view->question = SessionQuestion::mark;
            break;
        case Tool::save:
            wishes.controls.push_back({SessionAction::save});
            break;
        case Tool::finish:
            content.view->question = SessionQuestion::finish;
            break;
    }
}

/// The head's outline at twice its size on an ordinary display.
void draw_burr(const Burr& burr, const ImVec2& centre, float most_px) {
    const float radius =
        std::clamp(static_cast<float>(burr.diameter_mm) * 0.1f * most_px, 1.5f, 0.5f * most_px);
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
    canvas.AddLine({centre.x, centre.y}, {centre.x, centre.y - 0.5f * most_px}, colour, 2.0f);
    if (burr.is_ball())
        canvas.AddCircleFilled(centre, radius, colour);
    else
        canvas.AddRectFilled({centre.x - radius, centre.y - 0.4f * most_px},
                             {centre.x + radius, centre.y + 0.4f * most_px}, colour, 2.0f);
}

void draw_burr_list(const OverlayContent& content) {
    if (!ImGui::BeginPopup("burrs")) return;
    const float height = 1.6f * ImGui::GetFontSize();
    for (std::size_t i = 0; i < content.session->burrs.size(); ++i) {
        const Burr& burr = content.session->burrs[i];
        const std::string text = fmt::format("        {}: {}, {} edges, {:.0f} rpm##{}", i + 1,
                                             burr_words(burr), burr.edges, 60.0 * burr.spindle_rev_per_s, i);
        const ImVec2 place = ImGui::GetCursorScreenPos();
        if (ImGui::Selectable(text.c_str(), content.operator_command && content.operator_command->burr == i,
                              0, {0.0f, height}))
            content.wishes->burr = i;
        draw_burr(burr, {place.x + 0.6f * height, place.y + 0.5f * height}, height);
    }
    ImGui::EndPopup();
}

}  // namespace

bool has_tool_bar(const OverlayContent& content) {
    return content.wishes != nullptr && content.player == nullptr && content.session != nullptr &&
           content.session->accepts_controls && content.link.status == LinkStatus::live;
}

std::vector<glm::vec2> tool_bar_sizes(const OverlayContent& content, const PanelPainter&) {
    const auto all = buttons(content);
    return {size_of(all, true), size_of(all, false)};
}

void draw_tool_bar(const OverlayContent& content, const PanelPlace& place) {
    const InputPanel window("tool bar", place);
    const bool has_words = place.choice == 0;
    bool is_first = true;
    for (const ToolButton& button : buttons(content)) {
        if (!std::exchange(is_first, false)) ImGui::SameLine();
        ImGui::BeginDisabled(!button.is_enabled);
        if (button.is_on)
            ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        const std::string label =
            fmt::format("{}##{}", text_of(button, has_words), static_cast<int>(button.tool));
        if (ImGui::Button(label.c_str())) press(button.tool, content);
        if (button.is_on) ImGui::PopStyleColor();
        ImGui::EndDisabled();
        if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
            const std::string tip = button.word + ": " + button.tip;
            ImGui::SetTooltip("%s%s", tip.c_str(),
                              content.link.controls.may_control ? "" : "\nanother client has the seat");
        }
    }
    draw_burr_list(content);
}

}  // namespace osteomill
