// Lines of a table in text (CSV) as spreadsheets of any system and language save it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/text/utf8.h"

namespace osteomill {

/// Takes off what stands around a line: a carriage return, and of the file's first line the mark of UTF-8.
/// Throws std::runtime_error, in words, where the mark is UTF-16's.
inline void strip_line(std::string& line, bool is_first) {
    constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
    if (is_first && begins_as_utf16(line)) throw std::runtime_error("is text in UTF-16; save it as UTF-8");
    if (is_first && line.starts_with(utf8_mark)) line.erase(0, utf8_mark.size());
    if (line.ends_with('\r')) line.pop_back();
}

/// The next line, stripped; semicolons between cells become commas. `number` counts lines and is 0 before the
/// first. Throws std::runtime_error, in words, also for numbers with a comma for a point.
inline bool next_table_line(std::istream& in, std::string& line, std::size_t& number) {
    if (!std::getline(in, line)) return false;
    strip_line(line, ++number == 1);
    const bool is_comment = line.starts_with('#');
    if (is_comment || line.find(';') == std::string::npos) return true;
    if (line.find(',') != std::string::npos)
        throw std::runtime_error(
            "has semicolons between its cells and commas for points; write 0.5, not 0,5");
    std::replace(line.begin(), line.end(), ';', ',');
    return true;
}

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

}  // namespace osteomill
