#include "common/words/decimal_sign.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace osteomill {

namespace {

constexpr std::array<std::string_view, 1> languages_with_comma{"de"};

bool is_of_number(char letter) {
    return (letter >= '0' && letter <= '9') || letter == '.';
}

bool is_digit(char letter) {
    return is_of_number(letter) && letter != '.';
}

}  // namespace

std::string with_decimal_sign(std::string text, const std::string& language) {
    if (std::ranges::find(languages_with_comma, language) == languages_with_comma.end()) return text;
    for (auto first = text.begin(); first != text.end();) {
        first = std::find_if(first, text.end(), is_of_number);
        const auto end = std::find_if_not(first, text.end(), is_of_number);
        const auto point = std::find(first, end, '.');
        if (point != end && point != first && point + 1 != end && std::all_of(point + 1, end, is_digit))
            *point = ',';
        first = end;
    }
    return text;
}

}  // namespace osteomill
