#include "analysis/report/trainee_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "common/files/input_file.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

/// Windows-1252 from 0x80 on; above 0x9F it is Latin-1, whose numbers are Unicode's.
constexpr std::array<char16_t, 32> windows_1252{
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const Utf8Character next = first_character(text);
        if (!next.is_utf8) return false;
        text.remove_prefix(next.bytes);
    }
    return true;
}

std::string from_windows_1252(std::string_view text) {
    std::string utf8;
    for (const char letter : text) {
        const auto byte = static_cast<std::uint8_t>(letter);
        const unsigned code = byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80U] : byte;
        if (code < 0x80) {
            utf8 += letter;
        } else if (code < 0x800) {
            utf8 += static_cast<char>(0xC0U | code >> 6U);
            utf8 += static_cast<char>(0x80U | (code & 0x3FU));
        } else {
            utf8 += static_cast<char>(0xE0U | code >> 12U);
            utf8 += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
            utf8 += static_cast<char>(0x80U | (code & 0x3FU));
        }
    }
    return utf8;
}

/// In UTF-8, each line ended by \n.
std::string spreadsheet_text(const std::filesystem::path& file) {
    std::string text = read_text(file, table_kind);
    if (!is_utf8(text) && !begins_as_utf16(text)) text = from_windows_1252(text);
    std::string lines;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_before_newline = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_before_newline) lines += text[i] == '\r' ? '\n' : text[i];
    }
    return lines;
}

/// As teachers write it.
bool are_experts(std::string group) {
    for (char& letter : group)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    constexpr std::array<std::string_view, 6> words{"expert",   "experts",  "experte",
                                                    "experten", "expertin", "expertinnen"};
    return std::ranges::find(words, group) != words.end();
}

}  // namespace

std::map<std::string, TraineeGroup> trainee_groups(const std::filesystem::path& file) {
    std::istringstream lines(spreadsheet_text(file));
    std::map<std::string, TraineeGroup> groups;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto fail = [&](const std::string& why) {
            throw std::runtime_error(printable(fmt::format("{}:{}: {}", file.string(), number, why)));
        };
        try {
            strip_line(line, ++number == 1);
        } catch (const std::runtime_error& error) {
            fail(error.what());
        }
        if (trimmed(line).empty()) continue;
        std::vector<std::string> cells = quoted_cells(line, line.find(';') == std::string::npos ? ',' : ';');
        if (cells.size() < 2) fail("a line is TRAINEE,GROUP");
        if (number == 1 && cells.size() > 2 && trimmed(cells.front()) == "trainee")
            fail(fmt::format("has {} columns; a line is TRAINEE,GROUP alone", cells.size()));
        std::string group = trimmed(cells.back());
        if (are_experts(group)) group = expert_group;
        cells.pop_back();
        const std::string trainee = trimmed(fmt::format("{}", fmt::join(cells, ",")));
        if (number == 1 && trainee == "trainee" && group == "group") continue;
        if (trainee.empty() || group.empty()) fail("a line is TRAINEE,GROUP, and neither is empty");
        if (const auto [known, is_new] = groups.try_emplace(trainee, TraineeGroup{group, number});
            !is_new && known->second.group != group)
            fail(fmt::format("\"{}\" is in group \"{}\" already", trainee, known->second.group));
    }
    return groups;
}

}  // namespace osteomill
