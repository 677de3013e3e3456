#include "common/text/csv.h"

#include <algorithm>

#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

bool is_computed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && std::string_view("=+-@").find(text[first]) != text.npos;
}

}  // namespace

std::string csv_cell(std::string_view text) {
    std::string cell = one_line(text);
    if (is_computed(text)) cell.insert(cell.begin(), '\'');
    const bool has_blank_end = cell.starts_with(' ') || cell.ends_with(' ');
    if (cell.find_first_of(",\";'") == std::string::npos && !has_blank_end) return cell;
    std::string quoted(1, '"');
    for (const char letter : cell) quoted.append(letter == '"' ? 2 : 1, letter);
    quoted += '"';
    return quoted;
}

std::string with_utf8_mark(std::string table) {
    if (std::ranges::any_of(table, [](char letter) { return static_cast<unsigned char>(letter) >= 0x80; }))
        table.insert(0, "\xef\xbb\xbf");
    return table;
}

}  // namespace osteomill
