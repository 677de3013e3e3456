// Words and numbers of the window and of the report in a person's language. Words are found by the English
// ones, as gettext does. English is in the sources; every other language is a file beside this one:
// LANGUAGE.toml, "English" = "translated".
//
// A server speaks English (faults, notices), with its values filled in already: tr_filled finds the
// translation of the whole text.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace osteomill {

using Translation = std::map<std::string, std::string>;

/// Codes of ISO 639-1; "en" is the first.
std::vector<std::string> languages();
/// The translation into one of them; none for English. Throws std::out_of_range for another language.
const Translation& translation_into(const std::string& language);
/// The language that the environment asks for (LC_ALL, LC_MESSAGES, LANG; the first that is set), or English.
std::string language_of_environment();

/// From now on; one of languages(). Like the C library's locale it holds for the whole program: call it
/// before there are threads.
void speak(const std::string& language);
const std::string& spoken_language();

/// The text in the chosen language, or the English one if it is not translated. Lives for ever.
const char* tr(const char* english);
inline std::string tr(const std::string& english) {
    return tr(english.c_str());
}
/// The translation of a whole text whose values are filled in already: as it stands, with its numbers as {},
/// or else the text of the file that has {} where this one has names or paths, and the longest text besides.
/// Values keep their order. The English text if there is none.
std::string tr_filled(const std::string& english);
/// tr_filled, also of a text that begins with a file's name, which stays: "FILE: is no file", "FILE, packet 3
/// at byte 9: ...".
std::string tr_about_file(const std::string& english);
/// A tissue's or case's name as a person writes it: files write "Facial_Nerve".
std::string tissue_words(std::string name);
// Numbers as a person's language writes them: German ones with a decimal comma. Only for what people read:
// CSV, JSON and what a program reads again keep the point.

/// Every number of a text with the decimal sign of a language. Numbers with several points, such as versions,
/// stay as they are.
std::string with_decimal_sign(std::string text, const std::string& language = spoken_language());

/// Filled in as by fmt::format, with the decimal sign of the window's language. For texts without words.
template <typename... Values>
std::string spoken_number(fmt::format_string<Values...> text, Values&&... values) {
    return with_decimal_sign(fmt::format(text, std::forward<Values>(values)...));
}

/// A number that a person wrote, with a point or a comma, whatever the language; nothing if the text is none.
std::optional<double> number_written(std::string text);

/// A number among a text's values: formatted as by fmt, then with the language's decimal sign.
template <std::floating_point Number>
struct ReadNumber {
    Number value;
};

/// The translation of a text with places for values, filled in as fmt::format does, with the language's
/// decimal sign in numbers.
template <typename... Values>
std::string trf(const char* english, const Values&... values) {
    const auto read = []<typename Value>(const Value& value) -> decltype(auto) {
        if constexpr (std::is_floating_point_v<Value>)
            return ReadNumber<Value>{value};
        else
            return (value);
    };
    return fmt::format(fmt::runtime(tr(english)), read(values)...);
}

}  // namespace osteomill

template <std::floating_point Number>
struct fmt::formatter<osteomill::ReadNumber<Number>> {
    auto parse(fmt::format_parse_context& context) {
        const auto* const end = std::find(context.begin(), context.end(), '}');
        spec_.append(context.begin(), end);
        return end;
    }
    auto format(const osteomill::ReadNumber<Number>& number, fmt::format_context& context) const {
        const std::string text =
            osteomill::with_decimal_sign(fmt::format(fmt::runtime("{:" + spec_ + "}"), number.value));
        return std::copy(text.begin(), text.end(), context.out());
    }

  private:
    std::string spec_;
};
