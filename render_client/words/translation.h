// Words of the window in a person's language, found by the English ones as gettext does. English is in the
// sources; every other language is a file beside this one: LANGUAGE.toml, "English" = "translated".
//
// A server speaks English (faults, notices); a text of its is translated as a whole, numbers aside, if the
// file has it.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace osteomill {

using Translation = std::map<std::string, std::string>;

/// Codes of ISO 639-1; "en" is the first.
std::vector<std::string> languages();
/// Of one of them; none for English. Throws std::out_of_range for another.
const Translation& translation_into(const std::string& language);
/// As the environment asks for (LC_ALL, LC_MESSAGES, LANG; the first that is set), or English.
std::string language_of_environment();

/// From now on; one of languages(). Like the C library's locale it holds for the whole program: call it
/// before there are threads.
void speak(const std::string& language);

/// In the language that is spoken; where it has no such words, the English ones. Lives for ever.
const char* tr(const char* english);
inline std::string tr(const std::string& english) {
    return tr(english.c_str());
}
/// A text that the server says, as a whole; numbers in it stand in the file as {}, in the same order.
std::string tr_with_numbers(const std::string& english);
/// Of a tissue's name, as a person writes it: files write "Facial_Nerve".
std::string tissue_words(std::string name);
/// Of a text with places for values, as fmt::format.
template <typename... Values>
std::string trf(const char* english, const Values&... values) {
    return fmt::format(fmt::runtime(tr(english)), values...);
}

}  // namespace osteomill
