#include "render_client/ui/panels/tool_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "common/scene/burr_profile.h"
#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

struct ToolButton {
    Action action = Action::none;                              ///< as its key does it
    void (*press)(ViewSettings&, SessionRequests&) = nullptr;  ///< in its place
    std::string sign;
    std::string word;
    std::string tip;  ///< without the key, which is the action's
    bool is_enabled = true;
    bool is_on = false;
    bool opens_burrs = false;  ///< their list
};

std::string burr_words(const Burr& burr) {
    const std::string size = spoken_number("{:.1f} mm", burr.diameter_mm);
    const auto shape = static_cast<std::size_t>(burr.head.shape);
    return burr.is_ball() ? size : tr(std::string(head_shape_names[shape])) + " " + size;
}

/// The burr that the operator of this window chose; the burr in the tool if the tool is not theirs.
std::optional<std::size_t> burr_in_use(const SeenSession& session) {
    if (session.info == nullptr) return std::nullopt;
    std::optional<std::size_t> burr;
    if (session.tool) burr = session.tool->burr;
    if (session.operator_command) burr = session.operator_command->burr;
    return burr && session.info->burr_of(*burr) ? burr : std::nullopt;
}

std::vector<ToolButton> buttons(const SeenSession& session, const ViewSettings& view) {
    const SessionStatus& can = session.link.controls;
    const bool may = can.may_control;
    std::vector<ToolButton> buttons;
    // While a question is open it has no command; its buttons stay, so that no other moves into their place.
    const bool operates = session.info != nullptr && session.info->accepts_operator;
    const auto& command = session.operator_command;
    if (operates)
        buttons.push_back(
            {.press = [](ViewSettings&, SessionRequests& requests) { requests.switches_pedal = true; },
             .sign = "\u25CF",
             .word = tr("Pedal"),
             .tip = tr("the spindle turns until you press again, or while SPACE is held"),
             .is_enabled = may && command && !can.is_paused,
             .is_on = command && command->pedal});
    if (const std::optional<std::size_t> burr = burr_in_use(session))
        buttons.push_back({.press = [](ViewSettings&, SessionRequests&) { ImGui::OpenPopup("burrs"); },
                           .sign = "\u25CE",
                           .word = burr_words(session.info->burrs[*burr]),
                           .tip = trf("choose a burr (1 to 9, {} {}) and the spindle's speed ({} {})",
                                      key_of(Action::previous_burr), key_of(Action::next_burr),
                                      key_of(Action::slower), key_of(Action::faster)),
                           .is_enabled = may,
                           .opens_burrs = true});
    if (operates)
        buttons.push_back({.action = Action::tilt,
                           .sign = "\u2197",
                           .word = tr("Tilt"),
                           .tip = tr("left drag tilts the handpiece; the arrow keys do, too"),
                           .is_enabled = may && command,
                           .is_on = view.drag_tilts});
    buttons.push_back(
        {.action = Action::place,
         .sign = "\u25C9",
         .word = tr("Place"),
         .tip = tr("then click on bone: there the tool goes; with shift the handpiece is upright on it"),
         .is_enabled = may,
         .is_on = view.click_places});
    buttons.push_back(
        {.action = Action::move_bone,
         .sign = "\u21C4",
         .word = view.moves_bone ? tr("Let go") : tr("Move bone"),
         .tip = tr("left drag turns the bone under the tool, with shift it moves it, the wheel brings it "
                   "nearer; press again to go on there"),
         .is_enabled = may,
         .is_on = view.moves_bone});
    if (session.info != nullptr && session.info->has_ct)
        buttons.push_back({.action = Action::slices,
                           .sign = "\u25A6",
                           .word = "CT",
                           .tip = tr("slices of the CT"),
                           .is_on = view.slices_shown});
    const auto counted = [](const char* word, std::uint32_t count) {
        return count > 0 ? fmt::format("{} {}", word, count) : std::string(word);
    };
    buttons.push_back({.action = Action::undo,
                       .sign = "\u21B6",
                       .word = counted(tr("Undo"), can.undo_steps),
                       .tip = tr("gives back what the last stroke took"),
                       .is_enabled = may && can.undo_steps > 0});
    buttons.push_back({.action = Action::redo,
                       .sign = "\u21B7",
                       .word = counted(tr("Redo"), can.redo_steps),
                       .tip = tr("the stroke that was undone last"),
                       .is_enabled = may && can.redo_steps > 0});
    buttons.push_back(
        {.press = [](ViewSettings& its, SessionRequests&) { its.question = SessionQuestion::reset; },
         .sign = "\u21BA",
         .word = tr("Reset"),
         .tip = tr("undoes all strokes"),
         .is_enabled = may && can.undo_steps > 0});
    buttons.push_back({.action = Action::hold,
                       .sign = can.is_paused ? "\u25B6" : "\u275A\u275A",
                       .word = can.is_paused ? tr("Go on") : tr("Pause"),
                       .tip = can.is_paused
                                  ? tr("force comes back once the burr is clear of bone, the spindle "
                                       "once the pedal was up")
                                  : tr("force and spindle off"),
                       .is_enabled = may,
                       .is_on = can.is_paused});
    buttons.push_back({.action = Action::mark,
                       .sign = "\u2691",
                       .word = tr("Mark"),
                       .tip = tr("this moment, with a note, for the report"),
                       .is_enabled = may});
    buttons.push_back({.action = Action::save,
                       .sign = "\u21E9",
                       .word = tr("Save"),
                       .tip = tr("the bone as it is, where the server saves it"),
                       .is_enabled = may});
    buttons.push_back({.action = Action::save_surface,
                       .sign = "\u25B3",
                       .word = tr("Surface"),
                       .tip = tr("the bone's surface as it is, as STL, PLY or OBJ"),
                       .is_enabled = may});
    buttons.push_back({.action = Action::finish,
                       .sign = "\u25A0",
                       .word = tr("Finish"),
                       .tip = tr("ends the session; all is saved"),
                       .is_enabled = may});
    return buttons;
}

std::string text_of(const ToolButton& button, bool has_words) {
    return has_words ? button.sign + " " + button.word : button.sign;
}

/// For a small picture: the least used are left to their keys.
std::vector<ToolButton> without_least_used(std::vector<ToolButton> buttons) {
    std::erase_if(buttons, [](const ToolButton& b) {
        return b.action == Action::move_bone || b.action == Action::save_surface;
    });
    return buttons;
}

glm::vec2 size_of(const std::vector<ToolButton>& buttons, bool has_words) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 2.0f * style.WindowPadding.x - style.ItemSpacing.x;
    for (const ToolButton& button : buttons)
        width += ImGui::CalcTextSize(text_of(button, has_words).c_str()).x + 2.0f * style.FramePadding.x +
                 style.ItemSpacing.x;
    return {std::ceil(width), ImGui::GetFrameHeight() + 2.0f * style.WindowPadding.y};
}

void press(const ToolButton& button, ViewSettings& view, SessionRequests& requests) {
    button.press ? button.press(view, requests) : requests.actions.push_back(button.action);
}

/// The head's section through the spindle, tip down, with its shank, to the scale of the largest of a set: a
/// pixel for each `mm_per_px`.
void draw_burr(const Burr& burr, const ImVec2& first, const ImVec2& size, float mm_per_px) {
    constexpr int steps = 24;  // on half the outline
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
    const float radius_mm = static_cast<float>(burr.radius_mm());
    const float middle = first.x + 0.5f * size.x;
    // The tip lies half a diameter below the head's origin.
    const auto at = [&](float out_mm, float height_mm) {
        return ImVec2{middle + out_mm / mm_per_px,
                      first.y + size.y - std::max(height_mm + radius_mm, 0.0f) / mm_per_px};
    };
    std::array<ImVec2, 2 * steps + 2> points;
    float top_mm = radius_mm;
    if (burr.is_ball()) {
        for (int i = 0; i <= steps; ++i) {
            const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / steps;
            points[i] = at(radius_mm * std::sin(angle), -radius_mm * std::cos(angle));
        }
    } else {
        const BurrProfile profile(burr.head, burr.diameter_mm);
        for (int i = 0; i <= steps; ++i) {
            const OutlinePoint point = profile.outline_at(profile.outline_length() * i / steps);
            points[i] = at(static_cast<float>(point.radius), static_cast<float>(point.height));
        }
        top_mm = static_cast<float>(profile.top_height());
    }
    for (int i = 0; i <= steps; ++i) {
        const ImVec2& right = points[steps - i];
        points[steps + 1 + i] = {2.0f * middle - right.x, right.y};
    }
    canvas.AddLine(at(0.0f, 0.9f * top_mm), {middle, first.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                   2.0f);
    canvas.AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), ink);
    // Draws the edges that can be seen from one side.
    for (int edge = 1; edge < burr.edges / 2; ++edge) {
        const float across = 2.0f * static_cast<float>(edge) / static_cast<float>(burr.edges / 2) - 1.0f;
        const int seen = steps / 2;
        const float half = points[seen].x - middle;
        canvas.AddLine({middle + 0.8f * across * half, points[steps / 4].y},
                       {middle + 0.8f * across * half, points[3 * steps / 4].y},
                       ImGui::GetColorU32(ImGuiCol_PopupBg), 1.0f);
    }
}

/// The largest extent of a set's heads, along the axis from tip to end, or across.
float largest_mm(const std::vector<Burr>& burrs) {
    double largest_mm = 0.5;
    for (const Burr& burr : burrs) largest_mm = std::max({largest_mm, burr.diameter_mm, burr.head.length_mm});
    return static_cast<float>(largest_mm);
}

/// Sends the speed when the slider is let go, not on its way.
void draw_speed(const SeenSession& session, SessionRequests& requests) {
    const Burr* in_tool = session.burr_in_tool();
    if (in_tool == nullptr) return;
    constexpr float slowest_rpm = 1000.0f;
    constexpr float fastest_rpm = 100'000.0f;
    const double own_rpm = 60.0 * in_tool->spindle_rev_per_s;
    ImGui::Separator();
    // While it is dragged the slider has a value of its own.
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID dragged = ImGui::GetID("dragged rpm");
    float rpm = storage.GetFloat(dragged, 0.0f);
    if (rpm == 0.0f) rpm = static_cast<float>(spindle_rpm(*session.tool, *in_tool));
    ImGui::SetNextItemWidth(14.0f * ImGui::GetFontSize());
    ImGui::SliderFloat("##rpm", &rpm, std::min(slowest_rpm, static_cast<float>(own_rpm)),
                       std::max(fastest_rpm, static_cast<float>(own_rpm)), trf("{:.0f} rpm", rpm).c_str(),
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    storage.SetFloat(dragged, ImGui::IsItemActive() ? rpm : 0.0f);
    const auto choose = [&](double chosen_rpm) {
        requests.controls.push_back({.action = SessionAction::speed, .spindle_rpm = chosen_rpm});
    };
    if (ImGui::IsItemDeactivatedAfterEdit())
        choose(std::clamp(100.0 * std::round(rpm / 100.0), least_spindle_rpm, most_spindle_rpm));
    ImGui::SameLine();
    if (ImGui::Button(trf("its own: {:.0f}", own_rpm).c_str())) choose(0.0);
}

/// The next window, `width` wide, stands below the tool bar, whose buttons it leaves free, under `x`.
void place_below_bar(float x, float width) {
    const float below = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    const float last = ImGui::GetIO().DisplaySize.x - width;
    ImGui::SetNextWindowPos({std::max(std::min(x, last), 0.0f), below + 2.0f}, ImGuiCond_Always);
}

void draw_tip(const std::string& tip, float x) {
    const float widest = 34.0f * ImGui::GetFontSize();
    const float width = ImGui::CalcTextSize(tip.c_str(), nullptr, false, widest).x;
    place_below_bar(x, width + 2.0f * ImGui::GetStyle().WindowPadding.x);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(widest);
    ImGui::TextUnformatted(tip.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void draw_burr_list(const SeenSession& session, SessionRequests& requests, float x) {
    place_below_bar(x, 30.0f * ImGui::GetFontSize());
    if (!ImGui::BeginPopup("burrs")) return;
    const float height = 2.6f * ImGui::GetFontSize();
    const float mm_per_px = 1.15f * largest_mm(session.info->burrs) / height;
    for (std::size_t i = 0; i < session.info->burrs.size(); ++i) {
        const Burr& burr = session.info->burrs[i];
        const std::string text = fmt::format(
            "           {}: {}##{}", i + 1,
            trf("{}, {} edges, {:.0f} rpm", burr_words(burr), burr.edges, 60.0 * burr.spindle_rev_per_s), i);
        const ImVec2 place = ImGui::GetCursorScreenPos();
        ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0f, 0.5f});
        const auto flags =
            session.operator_command ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
        if (ImGui::Selectable(text.c_str(), burr_in_use(session) == i, flags, {0.0f, height}))
            requests.burr = i;
        ImGui::PopStyleVar();
        draw_burr(burr, {place.x, place.y + 1.0f}, {height, height - 2.0f}, mm_per_px);
    }
    draw_speed(session, requests);
    ImGui::EndPopup();
}

}  // namespace

std::vector<glm::vec2> tool_bar_sizes(const SeenSession& session, const ViewSettings& view) {
    const auto all = buttons(session, view);
    return {size_of(all, true), size_of(all, false), size_of(without_least_used(all), false)};
}

void draw_tool_bar(const SeenSession& session, ViewSettings& view, const PanelPlace& place,
                   SessionRequests& requests) {
    const WidgetPanel window("tool bar", place);
    const bool has_words = place.choice == 0;
    bool is_first = true;
    float burr_x = place.first.x;
    const auto all = buttons(session, view);
    for (const ToolButton& button : place.choice < 2 ? all : without_least_used(all)) {
        if (!std::exchange(is_first, false)) ImGui::SameLine();
        ImGui::BeginDisabled(!button.is_enabled);
        // One that is on looks so under the mouse, too.
        const int colours = button.is_on ? 2 : 0;
        if (button.is_on)
            for (const ImGuiCol of : {ImGuiCol_Button, ImGuiCol_ButtonHovered})
                ImGui::PushStyleColor(of, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        if (ImGui::Button(text_of(button, has_words).c_str())) press(button, view, requests);
        if (button.opens_burrs) burr_x = ImGui::GetItemRectMin().x;
        ImGui::PopStyleColor(colours);
        ImGui::EndDisabled();
        if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
            std::string tip = button.word + ": " + button.tip;
            if (const std::string key = key_of(button.action); !key.empty()) tip += " (" + key + ")";
            if (!session.link.controls.may_control) tip += tr("\nanother client has the seat");
            draw_tip(tip, ImGui::GetItemRectMin().x);
        }
    }
    draw_burr_list(session, requests, burr_x);
}

}  // namespace osteomill
