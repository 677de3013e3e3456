#include "render_client/ui/panels/session_dialog.h"

#include <imgui.h>

#include <algorithm>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

struct Question {
    const char* text;
    const char* yes;
};

Question question_of(SessionQuestion question, SessionAtHand session) {
    switch (question) {
        case SessionQuestion::mark:
            return {tr("Mark this moment. A note, if you like:"), tr("Mark")};
        case SessionQuestion::reset:
            return {tr("Undo every stroke? Each can be redone."), tr("Reset")};
        case SessionQuestion::finish:
            return {session == SessionAtHand::own ? tr("Finish the session? All is saved.")
                                                  : tr("Finish the session, for everybody? All is saved."),
                    tr("Finish")};
        case SessionQuestion::surface:
            return {tr("Save the surface of the bone as it is, beside the bone that the server saves, as:"),
                    "STL"};
        case SessionQuestion::end:
            if (session == SessionAtHand::none) return {tr("End this program?"), tr("End")};
            if (session == SessionAtHand::own)
                return {tr("End this program, and the session that it started? All is saved."), tr("End")};
            return {tr("End this program? The session goes on without it."), tr("End")};
        case SessionQuestion::none:
            break;
    }
    return {"", ""};
}

void answer(ViewSettings& view, SessionRequests& requests) {
    switch (view.question) {
        case SessionQuestion::mark:
            requests.controls.push_back({SessionAction::mark, view.note.data()});
            break;
        case SessionQuestion::reset:
            requests.controls.push_back({SessionAction::reset});
            break;
        case SessionQuestion::finish:
            requests.controls.push_back({SessionAction::finish});
            break;
        case SessionQuestion::surface:
            requests.controls.push_back({SessionAction::save, ".stl"});
            break;
        case SessionQuestion::end:
            requests.ends_program = true;
            break;
        case SessionQuestion::none:
            break;
    }
    view.question = SessionQuestion::none;
    view.note.fill('\0');
}

}  // namespace

glm::vec2 session_dialog_size(const ViewSettings& view, SessionAtHand session) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float lines = view.question == SessionQuestion::mark ? 3.0f : 2.0f;
    const float width =
        std::max(ImGui::CalcTextSize(question_of(view.question, session).text).x,
                 (view.question == SessionQuestion::end ? 30.0f : 20.0f) * ImGui::GetFontSize());
    return {width + 2.0f * style.WindowPadding.x,
            lines * ImGui::GetFrameHeightWithSpacing() + 2.0f * style.WindowPadding.y};
}

void draw_session_dialog(ViewSettings& view, SessionAtHand session, const PanelPlace& place,
                         SessionRequests& requests) {
    // A panel that keys do not reach gives its field no keyboard (Dear ImGui 1.90).
    const WidgetPanel window(
        "question", place, WidgetPanel::Background::filled, WidgetPanel::Size::whole,
        view.question == SessionQuestion::mark ? WidgetPanel::Keys::reach_it : WidgetPanel::Keys::none);
    draw_question(view, session, requests);
}

void draw_question(ViewSettings& view, SessionAtHand session, SessionRequests& requests) {
    const bool takes_note = view.question == SessionQuestion::mark;
    const Question question = question_of(view.question, session);
    ImGui::TextUnformatted(question.text);
    bool is_answered = false;
    if (takes_note) {
        ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        is_answered = ImGui::InputText("##note", view.note.data(), view.note.size(),
                                       ImGuiInputTextFlags_EnterReturnsTrue);
    }
    is_answered |= ImGui::Button(question.yes) || ImGui::IsKeyPressed(ImGuiKey_Enter);
    ImGui::SameLine();
    if (view.question == SessionQuestion::surface)
        for (const auto& [kind, ending] : {std::pair("PLY", ".ply"), {"OBJ", ".obj"}}) {
            if (ImGui::Button(kind)) {
                requests.controls.push_back({SessionAction::save, ending});
                view.question = SessionQuestion::none;
            }
            ImGui::SameLine();
        }
    const bool is_given_up = ImGui::Button(tr("Go on"));
    if (view.question == SessionQuestion::end) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", trf("RETURN: end   {}: go on", key_of(Action::end)).c_str());
    }
    if (is_answered)
        answer(view, requests);
    else if (is_given_up)
        view.question = SessionQuestion::none;
}

}  // namespace osteomill
