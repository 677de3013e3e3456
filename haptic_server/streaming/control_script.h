// Controls of a session that are due at given times, from a CSV file. They replace a person at the tool bar
// in tests and studies that repeat to the bit.
//
//     t_s,action,text
//     4.0,mark,before the second stroke
//     5.5,undo,
//     6.0,speed,30000
//
// The first line must be this header. Times ascend or repeat. `action` is mark, pause, resume, undo, redo,
// reset, save, finish, speed or fixture; `text`, all that follows, is a mark's note, rev/min (0: each burr's
// own), or a fixture's name with =on or =off.
// Blank lines and lines that begin with # are skipped. Anything else is refused with file and line.
#pragma once

#include <deque>
#include <filesystem>
#include <string>

#include "common/session/session_control.h"

namespace osteomill {

struct TimedControl {
    double time_s = 0.0;  ///< session time
    SessionControl control;

    bool operator==(const TimedControl&) const = default;
};

using ControlScript = std::deque<TimedControl>;

/// Throws std::runtime_error with one line: file, line, what is wrong, what would be right.
ControlScript read_control_script(const std::filesystem::path& file);
/// The same of a text; `name` stands for the file in errors.
ControlScript read_control_script(const std::string& text, const std::string& name);

}  // namespace osteomill
