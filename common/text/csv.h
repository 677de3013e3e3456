// Tables in text (CSV): lines as spreadsheets of any system and language save them, and cells that a
// spreadsheet shows as text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/text/foreign_text.h"

namespace osteomill {

// Lines of a table in text (CSV) as spreadsheets of any system and language save it.

/// Removes a carriage return at a line's end and, from the file's first line, the mark of UTF-8. Throws
/// std::runtime_error with a reason if the mark is UTF-16's.
inline void strip_line(std::string& line, bool is_first) {
    constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
    if (is_first && begins_as_utf16(line)) throw std::runtime_error("is text in UTF-16; save it as UTF-8");
    if (is_first && line.starts_with(utf8_mark)) line.erase(0, utf8_mark.size());
    if (line.ends_with('\r')) line.pop_back();
}

/// The lines of a table that are neither blank nor a comment (#). Semicolons between cells become
/// commas.
class TableLines {
  public:
    /// `name` stands for the file in messages.
    TableLines(const std::string& text, std::string name) : in_(text), name_(std::move(name)) {}

    /// Whether there is one more. Throws as fail does, also for numbers with a comma for a point.
    bool next() {
        while (std::getline(in_, line_)) {
            ++number_;
            try {
                strip_line(line_, number_ == 1);
            } catch (const std::runtime_error& error) {
                fail(error.what());
            }
            if (line_.starts_with('#') || line_.find_first_not_of(" \t") == std::string::npos) continue;
            if (line_.find(';') == std::string::npos) return true;
            if (line_.find(',') != std::string::npos)
                fail("has semicolons between its cells and commas for points; write 0.5, not 0,5");
            std::replace(line_.begin(), line_.end(), ';', ',');
            return true;
        }
        return false;
    }
    const std::string& line() const { return line_; }
    /// The line's number, from 1.
    int number() const { return number_; }

    /// Throws std::runtime_error, "NAME:LINE: WHY".
    [[noreturn]] void fail(const std::string& why) const {
        throw std::runtime_error(name_ + ":" + std::to_string(std::max(number_, 1)) + ": " + why);
    }

  private:
    std::istringstream in_;
    std::string name_;
    std::string line_;
    int number_ = 0;
};

/// The cells of a line between commas or semicolons, whichever `separator` is; within quotes they are text,
/// and two quotes are one.
inline std::vector<std::string> quoted_cells(std::string_view line, char separator) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (line[i] == '"')
            is_quoted = !is_quoted;
        else if (line[i] == separator && !is_quoted)
            cells.emplace_back();
        else
            cells.back() += line[i];
    }
    return cells;
}

// A text as a cell of a CSV file (RFC 4180), which a spreadsheet shows as text and does not compute.

/// One line, printable (foreign_text.h); in quotes if it holds a comma, a quote or a blank at an end. A text
/// that begins as a formula does (=, +, -, @), after blanks, too, gets an apostrophe before it, as
/// spreadsheets mark text. For texts alone: numbers go into a cell as they are.
std::string csv_cell(std::string_view text);

/// A table that holds more than ASCII begins with the mark of UTF-8: without it, Excel takes each letter for
/// two. One of ASCII stays as it is.
std::string with_utf8_mark(std::string table);

}  // namespace osteomill
