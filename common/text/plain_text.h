// Checks and display of names, paths and notes that come from outside the program.
//
// Text that is kept (a name in a file, an argument, a note) is checked once, on entry: it is plain, or
// refused. All displayed text goes through printable(). So no file or peer can break a log or steer a
// terminal, and a recording, whose texts are UTF-8, can always be read again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace osteomill {

/// Nothing for UTF-8 without control characters (utf8.h), line breaks and tabs among them; else what is
/// wrong, to go on behind the text's name: "is no UTF-8 (byte 2 is \xe4)".
std::optional<std::string> why_not_plain(std::string_view text);

/// Throws std::invalid_argument if it is not plain: "WHAT 'Z\xe4hne' is no UTF-8 (byte 2 is \xe4)".
void require_plain(std::string_view what, std::string_view text);

/// The text, each byte of a control character and each that is no UTF-8 as "\x1b".
std::string printable(std::string_view text);

/// The same of its first 200 bytes; a longer text is cut between characters and ends in "...".
std::string one_line(std::string_view text);

}  // namespace osteomill
