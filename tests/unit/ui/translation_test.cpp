#include "render_client/ui/words/translation.h"

#include <gmock/gmock.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "render_client/ui/input/key_bindings.h"

namespace osteomill::translation_test {
namespace {

using ::testing::IsEmpty;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// The literal that begins at `at`, with those that C++ joins to it; "" where there is none.
std::string literal_at(const std::string& source, std::size_t at) {
    std::string text;
    for (;;) {
        while (at < source.size() && std::isspace(static_cast<unsigned char>(source[at]))) ++at;
        if (at >= source.size() || source[at] != '"') break;
        for (++at; source[at] != '"'; ++at) {
            text += source[at];
            if (source[at] == '\\') text += source[++at];
        }
        ++at;
    }
    replace_all(text, "\\u00b3", "\u00b3");
    replace_all(text, "\\n", "\n");
    replace_all(text, "\\\"", "\"");
    return text;
}

/// All that the window's sources translate.
std::set<std::string> english_words() {
    std::set<std::string> words{"left", "back", "up"};  // axes of the plot
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WINDOW_SOURCES)) {
        if (entry.path().extension() != ".cpp") continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const std::string source = text.str();
        for (const std::string call : {"tr(", "trf("})
            for (std::size_t at = source.find(call); at != std::string::npos;
                 at = source.find(call, at + 1)) {
                const char before = at > 0 ? source[at - 1] : ' ';
                if (std::isalnum(static_cast<unsigned char>(before)) || before == '_') continue;
                words.insert(literal_at(source, at + call.size()));
            }
    }
    // Of the help, what is no name of a key.
    for (const Situation situation :
         {Situation::starting, Situation::drilling, Situation::looking_on, Situation::playing})
        for (const HelpLine& line : help_lines(situation)) {
            words.insert(line.meaning);
            for (std::size_t i = 1; i < line.name.size(); ++i)
                if (std::islower(static_cast<unsigned char>(line.name[i - 1])) &&
                    std::islower(static_cast<unsigned char>(line.name[i])))
                    words.insert(line.name);
        }
    words.erase("");
    return words;
}

/// "{:.1f}{}" of "at {:.1f} s in {}".
std::string places_in(const std::string& text) {
    std::string places;
    bool is_inside = false;
    for (const char letter : text) {
        is_inside = is_inside || letter == '{';
        if (is_inside) places += letter;
        is_inside = is_inside && letter != '}';
    }
    return places;
}

TEST(Translation, AreThereInEveryLanguageForAllThatTheSourcesTranslate) {
    const std::set<std::string> english = english_words();
    EXPECT_GT(english.size(), 200U);
    EXPECT_EQ(languages(), (std::vector<std::string>{"en", "de"}));
    for (const std::string& language : languages()) {
        if (language == "en") continue;
        std::vector<std::string> missing;
        for (const std::string& words : english)
            if (!translation_into(language).contains(words)) missing.push_back(words);
        EXPECT_THAT(missing, IsEmpty()) << language;
    }
}

TEST(Translation, HaveTheSamePlacesForValues) {
    for (const std::string& language : languages())
        for (const auto& [english, translated] : translation_into(language)) {
            EXPECT_EQ(places_in(translated), places_in(english)) << language << ": " << english;
            EXPECT_FALSE(translated.empty()) << language << ": " << english;
        }
}

TEST(Translation, AreEnglishUntilAnotherLanguageIsSpoken) {
    EXPECT_STREQ(tr("Finish"), "Finish");
    speak("de");
    EXPECT_STREQ(tr("Finish"), "Beenden");
    EXPECT_EQ(trf("depth {:.2f} mm", 1.234), "Tiefe 1.23 mm");
    EXPECT_STREQ(tr("no such words"), "no such words");
    speak("en");
    EXPECT_STREQ(tr("Finish"), "Finish");
    EXPECT_THROW(speak("xx"), std::out_of_range);
}

TEST(Translation, AreThoseOfTheEnvironmentsLanguage) {
    ::unsetenv("LC_ALL");
    ::unsetenv("LC_MESSAGES");
    ::setenv("LANG", "de_AT.UTF-8", 1);
    EXPECT_EQ(language_of_environment(), "de");
    ::setenv("LC_ALL", "C.UTF-8", 1);
    EXPECT_EQ(language_of_environment(), "en");
    ::unsetenv("LC_ALL");
    ::unsetenv("LANG");
    EXPECT_EQ(language_of_environment(), "en");
}

}  // namespace
}  // namespace osteomill::translation_test
