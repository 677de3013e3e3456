#include "common/words/translation.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <regex>
#include <string_view>

#include "common/text/words.h"
#include "common/words/embedded_words.h"

namespace osteomill {

namespace {

std::map<std::string, Translation> all_words() {
    std::map<std::string, Translation> all{{"en", {}}};
    for (const auto& [language, text] : embedded_words)
        for (const auto& [english, translated] : toml::parse(text))
            all[std::string(language)][std::string(english.str())] = translated.value_or(std::string());
    return all;
}

const std::map<std::string, Translation>& tables() {
    static const std::map<std::string, Translation> tables = all_words();
    return tables;
}

using Spoken = std::map<std::string, Translation>::const_iterator;

Spoken& spoken() {
    static Spoken language = tables().find("en");
    return language;
}

const Translation& words() {
    return spoken()->second;
}

constexpr std::string_view place = "{}";

std::string filled(std::string text, const std::vector<std::string>& values) {
    std::size_t from = 0;
    for (const std::string& value : values) {
        from = text.find(place, from);
        if (from == std::string::npos) break;
        text.replace(from, place.size(), value);
        from += value.size();
    }
    return text;
}

/// The parts of the text at the places where the pattern has {}; nothing if it does not fit, or if the
/// pattern has too few letters before its first place to be recognised by.
std::optional<std::vector<std::string>> values_in(std::string_view text, std::string_view pattern) {
    constexpr std::size_t fewest_letters = 8;
    std::size_t at = pattern.find(place);
    if (at == std::string_view::npos || at < fewest_letters || pattern.find("{:") != std::string_view::npos ||
        !text.starts_with(pattern.substr(0, at)))
        return std::nullopt;
    std::vector<std::string> values;
    for (text.remove_prefix(at);;) {
        pattern.remove_prefix(at + place.size());
        at = pattern.find(place);
        const std::string_view behind = pattern.substr(0, at);
        const bool is_last = at == std::string_view::npos;
        if (is_last && !text.ends_with(behind)) return std::nullopt;
        const std::size_t length = is_last ? text.size() - behind.size() : text.find(behind);
        if (length == std::string_view::npos) return std::nullopt;
        values.emplace_back(text.substr(0, length));
        if (is_last) return values;
        text.remove_prefix(length + behind.size());
    }
}

}  // namespace

std::vector<std::string> languages() {
    std::vector<std::string> names{"en"};
    for (const auto& [language, words] : tables())
        if (language != "en") names.push_back(language);
    return names;
}

const Translation& translation_into(const std::string& language) {
    return tables().at(language);
}

std::string language_of_environment() {
    for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
        if (const char* value = std::getenv(name); value != nullptr && *value != '\0') {
            const std::string language = std::string(value).substr(0, 2);
            return tables().contains(language) ? language : "en";
        }
    return "en";
}

void speak(const std::string& language) {
    (void)translation_into(language);  // throws
    spoken() = tables().find(language);
}

const std::string& spoken_language() {
    return spoken()->first;
}

std::string tr_filled(const std::string& english) {
    if (words().empty()) return english;
    if (const auto whole = words().find(english); whole != words().end()) return whole->second;
    static const std::regex number(R"(-?\d+(\.\d+)?)");
    const auto found = words().find(std::regex_replace(english, number, "{}"));
    if (found != words().end())
        return filled(found->second,
                      {std::sregex_token_iterator(english.begin(), english.end(), number), {}});
    const Translation::value_type* best = nullptr;
    for (const auto& entry : words())
        if (values_in(english, entry.first) && (best == nullptr || entry.first.size() > best->first.size()))
            best = &entry;
    return best != nullptr ? filled(best->second, *values_in(english, best->first)) : english;
}

std::string tr_about_file(const std::string& english) {
    if (std::string whole = tr_filled(english); whole != english) return whole;
    for (const std::string_view behind_name : {", packet ", ": "}) {
        std::size_t at = english.find(behind_name);
        if (at == std::string::npos) continue;
        if (behind_name == ": ") at += behind_name.size();
        const std::string rest = english.substr(at);
        if (std::string translated = tr_filled(rest); translated != rest)
            return english.substr(0, at) + translated;
    }
    return english;
}

std::string tissue_words(std::string name) {
    std::ranges::replace(name, '_', ' ');
    return tr_filled(name);
}

const char* tr(const char* english) {
    const auto found = words().find(english);
    return found != words().end() ? found->second.c_str() : english;
}

namespace {

constexpr std::array<std::string_view, 1> languages_with_comma{"de"};

bool is_of_number(char letter) {
    return (letter >= '0' && letter <= '9') || letter == '.';
}

bool is_digit(char letter) {
    return is_of_number(letter) && letter != '.';
}

}  // namespace

std::optional<double> number_written(std::string text) {
    std::erase(text, ' ');
    std::ranges::replace(text, ',', '.');
    return finite_number(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
}

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
