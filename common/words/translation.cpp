#include "render_client/words/translation.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <string_view>

#include "render_client/words/embedded_words.h"

namespace osteomill {

namespace {

std::map<std::string, Translation> all_words() {
    std::map<std::string, Translation> all{{"en", {}}};
    for (const auto& [language, text] : embedded_words())
        for (const auto& [english, translated] : toml::parse(text))
            all[std::string(language)][std::string(english.str())] = translated.value_or(std::string());
    return all;
}

const std::map<std::string, Translation>& tables() {
    static const std::map<std::string, Translation> tables = all_words();
    return tables;
}

const Translation*& spoken() {
    static const Translation* words = &tables().at("en");
    return words;
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
    spoken() = &tables().at(language);
}

std::string tr_with_numbers(const std::string& english) {
    static const std::regex number(R"(-?\d+(\.\d+)?)");
    const auto found = spoken()->find(std::regex_replace(english, number, "{}"));
    if (found == spoken()->end()) return tr(english);
    std::string translated = found->second;
    std::size_t from = 0;
    for (std::sregex_iterator at(english.begin(), english.end(), number), end; at != end; ++at) {
        from = translated.find("{}", from);
        if (from == std::string::npos) break;
        translated.replace(from, 2, at->str());
        from += at->str().size();
    }
    return translated;
}

std::string tissue_words(std::string name) {
    std::ranges::replace(name, '_', ' ');
    return tr(name);
}

const char* tr(const char* english) {
    const auto found = spoken()->find(english);
    return found != spoken()->end() ? found->second.c_str() : english;
}

}  // namespace osteomill
