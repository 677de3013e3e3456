// A text as a cell of a CSV file (RFC 4180), which a spreadsheet shows as text and does not compute.
#pragma once

#include <string>
#include <string_view>

namespace osteomill {

/// One line, printable (plain_text.h); in quotes if it holds a comma, a quote or a blank at an end. A text
/// that begins as a formula does (=, +, -, @), after blanks, too, gets an apostrophe before it, as
/// spreadsheets mark text. For texts alone: numbers go into a cell as they are.
std::string csv_cell(std::string_view text);

/// A table that holds more than ASCII begins with the mark of UTF-8: without it, Excel takes each letter for
/// two. One of ASCII stays as it is.
std::string with_utf8_mark(std::string table);

}  // namespace osteomill
