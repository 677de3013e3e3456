// Words, cells and numbers of lines that people or programs wrote.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

inline std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Without blanks around it.
inline std::string trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

/// A text of the file in a form that fits into a message.
inline std::string shortened(const std::string& text) {
    return text.size() <= 80 ? text : text.substr(0, 77) + "...";
}

inline std::vector<std::string> words_of(const std::string& text) {
    std::istringstream line(text);
    return {std::istream_iterator<std::string>(line), {}};
}

/// The texts between commas, without blanks around them; an empty line has one empty cell.
inline std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells;
    for (std::size_t from = 0;;) {
        const std::size_t to = line.find(',', from);
        cells.push_back(trimmed(line.substr(from, to - from)));
        if (to == std::string_view::npos) return cells;
        from = to + 1;
    }
}

/// Nothing if the text is anything but a number of that type.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// A finite number with a point, in any locale; nothing if anything else stands there.
inline std::optional<double> finite_number(std::string_view text) {
    const std::optional<double> number = parse_number<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Also "nan" and "inf"; nothing if anything else stands there.
inline std::optional<double> real_number(const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') return std::nullopt;
    return number;
}

/// "1,2.5,-3" as exactly so many finite numbers; nothing for anything else.
template <std::size_t count>
std::optional<std::array<double, count>> listed_numbers(const std::string& text) {
    std::array<double, count> numbers{};
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = i + 1 < count ? text.find(',', at) : text.size();
        if (end == std::string::npos) return std::nullopt;
        const std::optional<double> number = real_number(text.substr(at, end - at));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers[i] = *number;
        at = end + 1;
    }
    return numbers;
}

}  // namespace osteomill
