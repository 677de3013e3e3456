#include "haptic_server/streaming/control_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "common/files/input_file.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::string_view header = "t_s,action,text";

/// A placement needs a position, and has no place here.
constexpr std::array actions{SessionAction::mark,   SessionAction::pause,  SessionAction::resume,
                             SessionAction::undo,   SessionAction::redo,   SessionAction::reset,
                             SessionAction::save,   SessionAction::finish, SessionAction::speed,
                             SessionAction::fixture};

SessionAction action_named(std::string_view name) {
    std::vector<std::string_view> names;
    for (const SessionAction action : actions) {
        if (name == name_of(action)) return action;
        names.emplace_back(name_of(action));
    }
    throw std::invalid_argument(
        fmt::format("action '{}' is not one of {}", one_line(name), fmt::join(names, ", ")));
}

double number_in(std::string_view text, const char* name, const char* what) {
    const std::optional<double> number = finite_number(text);
    if (!number || *number < 0.0)
        throw std::invalid_argument(fmt::format("{} '{}' is not {}, 0 or more", name, one_line(text), what));
    return *number;
}

/// Reads "NAME=on" or "NAME=off".
void read_switch(SessionControl& control) {
    const std::size_t equals = control.text.rfind('=');
    const std::string_view to =
        equals == std::string::npos ? std::string_view() : std::string_view(control.text).substr(equals + 1);
    if (equals == 0 || (to != "on" && to != "off"))
        throw std::invalid_argument(
            fmt::format("the text '{}' is not a fixture's name, then =on or =off", control.text));
    control.is_on = to == "on";
    control.text.resize(equals);
}

TimedControl timed_control(std::string_view line) {
    const std::size_t first = line.find(',');
    const std::size_t second = first == std::string_view::npos ? first : line.find(',', first + 1);
    if (second == std::string_view::npos)
        throw std::invalid_argument(fmt::format("has fewer than the three columns {}", header));
    const std::string_view time = line.substr(0, first);
    TimedControl timed;
    timed.time_s = number_in(time, "t_s", "a number of seconds");
    if (timed.time_s > longest_session_s)
        throw std::invalid_argument(fmt::format("t_s is over {:.0f} s", longest_session_s));
    timed.control.action = action_named(line.substr(first + 1, second - first - 1));
    timed.control.text = line.substr(second + 1);
    if (const auto why = why_not_plain(timed.control.text)) throw std::invalid_argument("the text " + *why);
    if (timed.control.text.size() > SessionControl::longest_text)
        throw std::invalid_argument(fmt::format("the text has {} bytes; {} are the most",
                                                timed.control.text.size(), SessionControl::longest_text));
    if (timed.control.action == SessionAction::speed) {
        timed.control.spindle_rpm = number_in(timed.control.text, "the speed", "a number of rev/min");
        if (!is_spindle_speed(timed.control.spindle_rpm))
            throw std::invalid_argument("the speed is 100 to 500000 rpm, or 0 for each burr's own");
    }
    if (timed.control.action == SessionAction::fixture) read_switch(timed.control);
    return timed;
}

}  // namespace

ControlScript read_control_script(const std::string& text, const std::string& name) {
    ControlScript script;
    TableLines lines(text, name);
    if (!lines.next() || lines.line() != header) lines.fail(fmt::format("the first line must be {}", header));
    while (lines.next()) {
        try {
            script.push_back(timed_control(lines.line()));
        } catch (const std::invalid_argument& error) {
            lines.fail(error.what());
        }
        if (script.size() > 1 && script.back().time_s < script[script.size() - 2].time_s)
            lines.fail("t_s must not be earlier than on the line before");
    }
    return script;
}

ControlScript read_control_script(const std::filesystem::path& file) {
    return read_control_script(read_text(file, controls_kind), file.string());
}

}  // namespace osteomill
