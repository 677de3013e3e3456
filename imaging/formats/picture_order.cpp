#include "imaging/formats/picture_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "common/text/words.h"

namespace osteomill {

namespace {

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/// Words and a number behind them; the last of a name has none.
struct NamePart {
    std::string words{};
    std::string digits{};  ///< without zeros before them
    bool is_negative = false;
    bool has_number = false;
};

std::vector<NamePart> parts_of(const std::filesystem::path& path) {
    const std::string name = lower_case(path.stem().string());
    std::vector<NamePart> parts;
    for (std::string_view rest = name; !rest.empty();) {
        NamePart part;
        part.words = rest.substr(0, std::ranges::find_if(rest, is_digit) - rest.begin());
        rest.remove_prefix(part.words.size());
        part.digits = rest.substr(0, std::ranges::find_if_not(rest, is_digit) - rest.begin());
        rest.remove_prefix(part.digits.size());
        part.has_number = !part.digits.empty();
        part.digits.erase(0, std::min(part.digits.find_first_not_of('0'), part.digits.size()));
        const std::size_t length = part.words.size();
        const auto is_letter = [](unsigned char one) { return (one >= 'a' && one <= 'z') || one >= 0x80; };
        const bool follows_name =
            length > 1 ? is_letter(static_cast<unsigned char>(part.words[length - 2])) : !parts.empty();
        part.is_negative = part.has_number && part.words.ends_with('-') && !follows_name;
        if (part.is_negative) part.words.pop_back();
        parts.push_back(part);
    }
    return parts;
}

/// Below 0, 0 or above it, as the number of `a` is to that of `b`.
int compared(const NamePart& a, const NamePart& b) {
    if (a.is_negative != b.is_negative) return a.is_negative ? -1 : 1;
    const auto size = [](const NamePart& part) { return std::pair(part.digits.size(), part.digits); };
    const int order = size(a) < size(b) ? -1 : size(b) < size(a) ? 1 : 0;
    return a.is_negative ? -order : order;
}

std::int64_t number_of(const NamePart& part) {
    const auto number = parse_number<std::int64_t>(part.digits).value_or(0);
    return part.is_negative ? -number : number;
}

/// From one name to the next, where they differ in one number.
std::optional<std::int64_t> step_between(const std::filesystem::path& a, const std::filesystem::path& b) {
    const std::vector<NamePart> one = parts_of(a);
    const std::vector<NamePart> other = parts_of(b);
    if (one.size() != other.size() || a.extension() != b.extension()) return std::nullopt;
    std::optional<std::int64_t> step;
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (one[i].words != other[i].words || one[i].has_number != other[i].has_number) return std::nullopt;
        if (compared(one[i], other[i]) == 0) continue;
        if (step) return std::nullopt;
        step = number_of(other[i]) - number_of(one[i]);
    }
    return step;
}

}  // namespace

bool comes_before(const std::filesystem::path& a, const std::filesystem::path& b) {
    const std::vector<NamePart> one = parts_of(a);
    const std::vector<NamePart> other = parts_of(b);
    for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
        if (one[i].words != other[i].words) return one[i].words < other[i].words;
        if (one[i].has_number != other[i].has_number) return other[i].has_number;
        if (const int order = compared(one[i], other[i]); order != 0) return order < 0;
    }
    if (one.size() != other.size()) return one.size() < other.size();
    return a < b;
}

std::string doubt_of_order(const std::vector<std::filesystem::path>& files) {
    if (files.size() < 3) return {};
    std::vector<std::optional<std::int64_t>> steps;
    std::map<std::int64_t, std::size_t> times;
    std::size_t numbered = 0;
    for (std::size_t i = 1; i < files.size(); ++i) {
        steps.push_back(step_between(files[i - 1], files[i]));
        if (!steps.back()) continue;
        ++times[*steps.back()];
        ++numbered;
    }
    if (2 * numbered < steps.size()) return {};
    const auto usual = std::ranges::max_element(times, {}, [](const auto& one) { return one.second; });
    const auto odd = std::ranges::find_if(steps, [&](const auto& step) { return step != usual->first; });
    if (odd == steps.end()) return {};
    const auto before = static_cast<std::size_t>(odd - steps.begin());
    return fmt::format(
        "{}: the slice '{}' is followed by '{}', where most names differ by {}: is one missing, or one too "
        "many?",
        files.front().parent_path().string(), files[before].filename().string(),
        files[before + 1].filename().string(), usual->first);
}

}  // namespace osteomill
