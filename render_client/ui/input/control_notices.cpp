#include "render_client/ui/input/control_notices.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "common/words/translation.h"

namespace osteomill {

namespace {

/// A burr is lifted out two or three frames of the server's after the bone came back.
constexpr double lift_follows_s = 2.0;

const char* words_for(SessionAction done) {
    const std::array words{std::pair{SessionAction::mark, tr("marked")},
                           std::pair{SessionAction::resume, tr("the session goes on")},
                           std::pair{SessionAction::undo, tr("undone, given back:")},
                           std::pair{SessionAction::redo, tr("redone, taken again:")},
                           std::pair{SessionAction::reset, tr("all undone, given back:")},
                           std::pair{SessionAction::save, tr("the server saves the bone")},
                           std::pair{SessionAction::finish, tr("the session ends;")},
                           std::pair{SessionAction::place, tr("the tool is")},
                           std::pair{SessionAction::speed, tr("the spindle's speed:")},
                           std::pair{SessionAction::fixture, tr("help by force:")}};
    for (const auto& [action, word] : words)
        if (action == done) return word;
    return tr("the server did what this program does not know");
}

/// Translates "on" and "off" behind a name, which stays as it is: "NAME: on".
std::string switched_words(const std::string& text) {
    const std::size_t end = text.rfind(' ');
    return end == std::string::npos ? text : text.substr(0, end + 1) + tr(text.substr(end + 1));
}

/// In the window's language.
std::string words_of(const ControlEvent& event) {
    if (event.action == SessionAction::mark) return event.text;
    if (event.action == SessionAction::fixture && !event.is_refused) return switched_words(event.text);
    return tr_filled(event.text);
}

bool gives_bone_back(SessionAction action) {
    return action == SessionAction::undo || action == SessionAction::reset;
}

}  // namespace

std::string ControlNotices::notice_of(const ControlEvent& event, double now_s) {
    const std::string text = words_of(event);
    if (event.is_refused) return trf("no {}: {}", tr(name_of(event.action)), text);
    if (event.action == SessionAction::pause) return {};
    std::string notice = fmt::format("{} {}", words_for(event.action), text);
    const std::string before = std::exchange(came_back_, {});
    if (gives_bone_back(event.action)) {
        came_back_ = notice;
        came_back_s_ = now_s;
    } else if (event.action == SessionAction::place && !before.empty() &&
               now_s - came_back_s_ <= lift_follows_s) {
        notice = before + "; " + notice;
    }
    return notice;
}

}  // namespace osteomill
