#include "common/words/translation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/asio/error.hpp>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "analysis/report/condition_text.h"
#include "analysis/report/headlines.h"
#include "analysis/report/motion_metrics.h"
#include "analysis/report/session_metrics.h"
#include "common/program/progress.h"
#include "common/scene/burr.h"
#include "common/scene/rating_quantities.h"
#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "common/session/session_control.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/fault_remedy.h"
#include "render_client/ui/start/case_library.h"
#include "simulation/loop/burr_change.h"
#include "simulation/safety/fault.h"
#include "tests/support/has_word.h"

namespace osteomill::translation_test {
namespace {

using ::testing::ElementsAre;
using testing::has_word;
using ::testing::IsEmpty;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// The literal that begins at `at`, with those that C++ joins to it, and `at` behind it; "" if there is
/// none.
std::string literal_at(const std::string& source, std::size_t& at) {
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
    replace_all(text, "\\\\", "\\");
    return text;
}

/// A folder's sources, by file.
std::map<std::string, std::string> sources_in(const char* folder) {
    std::map<std::string, std::string> sources;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(REPOSITORY) / folder)) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
        std::ostringstream text;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);)
            if (!line.starts_with("#include")) text << line << '\n';
        sources[entry.path().filename().string()] = text.str();
    }
    return sources;
}

/// The offsets at which the arguments of each call of that function begin.
std::vector<std::size_t> calls_of(const std::string& source, const std::string& function) {
    std::vector<std::size_t> calls;
    for (std::size_t at = source.find(function + "("); at != std::string::npos;
         at = source.find(function + "(", at + 1)) {
        const char before = at > 0 ? source[at - 1] : ' ';
        if (!std::isalnum(static_cast<unsigned char>(before)) && before != '_')
            calls.push_back(at + function.size() + 1);
    }
    return calls;
}

/// Words among a call's arguments that are not handed to tr; text behind ## is not shown.
std::vector<std::string> bare_words(const std::string& source, std::size_t at) {
    std::vector<std::string> bare;
    for (int depth = 1; at < source.size() && depth > 0;) {
        if (source[at] != '"') {
            depth += source[at] == '(' ? 1 : source[at] == ')' ? -1 : 0;
            ++at;
            continue;
        }
        const std::string_view before = std::string_view(source).substr(0, at);
        const std::string text = literal_at(source, at);
        const bool is_translated = before.ends_with("tr(") || before.ends_with("trf(");
        if (!is_translated && has_word(text.substr(0, text.find("##")))) bare.push_back(text);
    }
    return bare;
}

std::vector<HelpLine> all_help() {
    std::vector<HelpLine> all;
    for (const Situation situation :
         {Situation::starting, Situation::drilling, Situation::looking_on, Situation::playing}) {
        const std::vector<HelpLine> lines = help_lines(situation);
        all.insert(all.end(), lines.begin(), lines.end());
    }
    return all;
}

/// As texts with filled places are looked up.
std::string with_places_for_numbers(const std::string& text) {
    return std::regex_replace(text, std::regex(R"(-?\d+(\.\d+)?)"), "{}");
}

/// Headings and names of all numbers of a report.
std::set<std::string> words_of_numbers() {
    SessionMetrics all{};
    all.structures = {{}};
    all.near.structures = {{}};
    all.exposures = {{}};
    all.plan.emplace();
    all.pass = {{"time_s", 1.0}};
    all.rating.items = {{}};
    all.removal.by_burr = all.removal.by_tissue = {{}};
    all.force.by_burr = all.force.by_tissue = {{}};
    std::set<std::string> words{"bone", "other bone", "tissue {}"};  // where a scene names none
    for (const MetricRow& row : metric_rows(all)) words.insert({row.group, row.text});
    for (const Headline& one : headlines) words.insert({one.text, text_of(one.better)});
    for (const double reaches_per_s : {1.0, 2.0, 4.0, 8.0}) words.insert(smoothness_word(reaches_per_s));
    for (const RatedQuantity& one : rated_quantities) words.insert(quantity_text(one.key, ""));
    std::set<std::string> looked_up{"and", "or", "not"};  // of a rating's conditions
    for (const std::string& text : words) {
        const std::string places = with_places_for_numbers(text);
        looked_up.insert(translation_into("de").contains(places) ? places : text);
    }
    return looked_up;
}

/// All texts that the window's and the report's sources translate, and the server's messages that it needs in
/// every session.
std::set<std::string> english_words() {
    std::set<std::string> words{"left", "back", "up"};  // axes of the plot
    for (const Fault fault : all_faults) {
        words.insert(describe(fault));
        words.insert(remedy_of(describe(fault)));
    }
    words.insert(remedy_of("another"));
    for (const BurrChange waits : {BurrChange::spindle, BurrChange::bone}) words.insert(describe(waits));
    for (auto action = SessionAction::none; action <= SessionAction::fixture;
         action = static_cast<SessionAction>(static_cast<int>(action) + 1))
        words.insert(name_of(action));
    for (const std::string_view shape : head_shape_names)
        if (shape != "ball") words.emplace(shape);  // which is "burr"
    for (const char* folder : {"render_client", "analysis/report"})
        for (const auto& [file, source] : sources_in(folder))
            for (const char* function : {"tr", "trf"})
                for (std::size_t arguments : calls_of(source, function))
                    words.insert(literal_at(source, arguments));
    words.merge(words_of_numbers());
    for (const ShelvedCase& built_in : cases_in("/nowhere"))
        words.insert({built_in.name, built_in.description});
    for (const ShippedScene& shipped : shipped_scenes) {
        const Scene scene = parse_scene(shipped.text, std::string(shipped.name));
        for (const Tissue& tissue : scene.tissues) {
            std::string as_written = tissue.name;
            std::ranges::replace(as_written, '_', ' ');
            words.insert(as_written);
        }
        for (const RatingItem& item : scene.rating) words.insert({item.name, item.source});
    }
    // All of the help, but names of keys.
    for (const HelpLine& line : all_help()) {
        words.insert(line.meaning);
        if (has_word(line.name)) words.insert(line.name);
    }
    words.erase("");
    return words;
}

/// "{}" for each place for a value: as texts of the server with numbers are translated.
std::string with_plain_places(const std::string& text) {
    return std::regex_replace(text, std::regex(R"(\{[^}]*\})"), "{}");
}

/// Every text in the sources of the server that may come over the link.
std::set<std::string> server_words() {
    std::set<std::string> words;
    for (const char* folder : {"simulation/loop", "haptic_server/program", "haptic_server/streaming",
                               "haptic_server/session", "common/net"})
        for (const auto& [file, source] : sources_in(folder))
            for (std::size_t at = source.find('"'); at != std::string::npos; at = source.find('"', at)) {
                const std::string text = literal_at(source, at);
                words.insert({text, with_plain_places(text)});
            }
    // Faults of a recording, behind the place in it.
    const std::string in_recording = ", packet {} at byte {}: ";
    words.insert(in_recording + "{}");
    for (const char* folder : {"common/recording", "common/wire"})
        for (const auto& [file, source] : sources_in(folder))
            for (std::size_t at = source.find('"'); at != std::string::npos; at = source.find('"', at)) {
                const std::string text = literal_at(source, at);
                words.insert({text, in_recording + text});
            }
    // How far a program of the start page is (common/program/progress.h).
    for (const double left_s : {5.0, 200.0, 7500.0}) words.insert(with_places_for_numbers(time_left(left_s)));
    words.insert({"reading", "looking for specks", "refining"});
    words.insert("cannot be written: {}");  // of an output file (common/files)
    words.insert("no more than {} frames could be written: " + std::generic_category().message(ENOSPC));
    for (const int error :
         {ENOENT, EACCES, ENOSPC, ECONNREFUSED, ECONNRESET, EHOSTUNREACH, ENETUNREACH, ETIMEDOUT})
        words.insert(std::generic_category().message(error));
    for (const auto error :
         {boost::asio::error::host_not_found, boost::asio::error::host_not_found_try_again})
        words.insert(boost::asio::error::get_netdb_category().message(error));
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

TEST(Translation, AreOfNothingThatTheSourcesDoNotSay) {
    std::set<std::string> said = english_words();
    said.merge(server_words());
    for (const HelpLine& line : all_help()) said.insert(line.name);  // keys have names, too
    for (const std::string& language : languages())
        for (const auto& [english, translated] : translation_into(language))
            EXPECT_TRUE(said.contains(english)) << language << ": " << english;
}

TEST(Translation, LeaveNoWordsOfThePanelsAside) {
    for (const auto& [file, source] : sources_in("render_client/ui"))
        for (const char* function :
             {"Text",         "TextUnformatted", "TextDisabled", "TextWrapped", "SetTooltip",
              "Button",       "Checkbox",        "Selectable",   "BeginCombo",  "SliderFloat",
              "ColorEdit3",   "InputText",       "InputDouble",  "button",      "text_field",
              "number_field", "draw_on_picture", "draw_text",    "line",        "say"})
            for (const std::size_t arguments : calls_of(source, function))
                EXPECT_THAT(bare_words(source, arguments), IsEmpty()) << file << ": " << function;
    EXPECT_THAT(bare_words(R"(tr("a word"), "%.0f HU", size("bare " "word"), "##hidden") and "more")", 0),
                ElementsAre("bare word"));
}

/// A key of an action within a text, as a person would type it there; "" if there is none.
std::string key_in(const std::string& text) {
    for (const KeyBinding& binding : key_bindings()) {
        const std::string key = key_of(binding.action);
        if (key == "N" || binding.situation == Situation::playing) continue;  // newtons; SPACE, the pedal
        const bool is_name = !key.empty() && std::ranges::all_of(key, [](unsigned char letter) {
            return std::isupper(letter) || std::isdigit(letter);
        });
        if (is_name && std::regex_search(text, std::regex("\\b" + key + "\\b"))) return key;
    }
    return text.find("[ ]") != std::string::npos ? "[ ]" : "";
}

TEST(Translation, NamesKeysAsTheirTableDoes) {
    const std::map<std::string, std::string> sources = sources_in("render_client/ui");
    for (const auto& [file, source] : sources) {
        if (file == "key_bindings.cpp") continue;  // the table, and the help beside it
        for (const char* function : {"tr", "trf"})
            for (std::size_t arguments : calls_of(source, function)) {
                const std::string text = literal_at(source, arguments);
                EXPECT_EQ(key_in(text), "") << file << ": " << text;
            }
    }
    EXPECT_EQ(key_in("Finish, or F10, ends it"), "F10");
    EXPECT_EQ(key_in("pause first (H)"), "H");
    EXPECT_EQ(key_in("Hold SPACE: 3 N, with {}"), "");
}

/// A literal, which may begin or end within a tag, without tags and the program's name.
std::string without_tags(const std::string& literal) {
    return std::regex_replace(literal, std::regex("^[^<>]*>|<[^>]*>?|Osteomill"), "");
}

TEST(Translation, LeaveNoWordsOfTheReportAside) {
    // Classes of the style, libpng's error and the address of a picture.
    const std::set<std::string> of_no_page{
        "reached", "missed", "two", "first", "cannot make a PNG picture: ", "data:image/png;base64,"};
    const auto sources = sources_in("analysis/report");
    std::size_t literals = 0;
    for (const char* file : {"first_page.cpp", "metrics_html.cpp", "session_pictures.cpp", "rating_html.cpp",
                             "report_html.cpp", "session_plots.cpp"}) {
        const std::string& source = sources.at(file);
        for (std::size_t at = source.find('"'); at != std::string::npos; at = source.find('"', at)) {
            const std::string_view before = std::string_view(source).substr(0, at);
            const bool is_translated = before.ends_with("tr(") || before.ends_with("trf(");
            const std::string text = literal_at(source, at);
            const bool is_key = text.find('_') != std::string::npos && text.find(' ') == std::string::npos;
            const bool is_class =
                of_no_page.contains(text) || text == " passed" || text == " failed" || text == " touched";
            ++literals;
            EXPECT_TRUE(is_translated || is_key || is_class || !has_word(without_tags(text)))
                << file << ": " << text;
        }
    }
    EXPECT_GT(literals, 100U);
}

TEST(Translation, AreThereForAllThatAServerAnswersToAWindow) {
    const auto streaming = sources_in("haptic_server/streaming");
    const auto session = sources_in("haptic_server/session");
    std::size_t texts = 0;
    for (const std::string& source : {streaming.at("control_runner.cpp"), session.at("tool_place.cpp")})
        for (std::size_t at = source.find('"'); at != std::string::npos; at = source.find('"', at)) {
            const std::string text = with_plain_places(literal_at(source, at));
            if (!has_word(text)) continue;
            ++texts;
            for (const std::string& language : languages())
                EXPECT_TRUE(language == "en" || translation_into(language).contains(text)) << text;
        }
    EXPECT_GT(texts, 10U);
}

TEST(Translation, KeepTheNamesOfWhatTheServerSays) {
    speak("de");
    EXPECT_EQ(tr_filled("the bone was not saved: /a/{}b 3.nrrd: No space left on device"),
              "der Knochen wurde nicht gespeichert: /a/{}b 3.nrrd: No space left on device");
    EXPECT_EQ(tr_about_file("/a/b.nrrd: cannot be written: Input/output error"),
              "/a/b.nrrd: lässt sich nicht schreiben: Input/output error");
    EXPECT_EQ(tr_filled("its report: /home/x/on the server/report.html on the server"),
              "ihr Bericht: /home/x/on the server/report.html auf dem Server");
    EXPECT_EQ(tr_about_file("/a/b.pcap: no more than 1234 frames could be written: No space left on device"),
              "/a/b.pcap: nach 1234 Bildern ließ sich nichts mehr schreiben: die Platte ist voll");
    EXPECT_EQ(tr_filled("nothing like that: here"), "nothing like that: here");
    EXPECT_EQ(tissue_words("tissue 3"), "Gewebe 3");
    EXPECT_EQ(tissue_words("Sinus_+_Dura"), "Sinus und Dura");
    speak("en");
    EXPECT_EQ(tissue_words("Sinus_+_Dura"), "Sinus + Dura");
}

TEST(Translation, SayWhatIsWrongWithARecordingBehindItsName) {
    speak("de");
    EXPECT_EQ(tr_about_file("/a b/x.pcap: ends before the bone is complete"),
              "/a b/x.pcap: endet, bevor der Knochen vollständig ist");
    EXPECT_EQ(tr_about_file("x.pcap, packet 3 at byte 812: a frame's checksum does not hold"),
              "x.pcap, Paket 3 ab Byte 812: die Prüfsumme stimmt nicht, es ist beschädigt");
    EXPECT_EQ(tr_about_file("x.pcap, packet 3 at byte 812: the scene has no burr"),
              "x.pcap, Paket 3 ab Byte 812: the scene has no burr");
    EXPECT_EQ(tr_about_file("nothing is left to undo"), "nichts ist mehr zurückzunehmen");
    EXPECT_EQ(tr_about_file("x.pcap: nothing like that"), "x.pcap: nothing like that");
    speak("en");
    EXPECT_EQ(tr_about_file("x.pcap: ends before the bone is complete"),
              "x.pcap: ends before the bone is complete");
}

TEST(Translation, HaveTheSamePlacesForValues) {
    for (const std::string& language : languages())
        for (const auto& [english, translated] : translation_into(language)) {
            EXPECT_EQ(places_in(translated), places_in(english)) << language << ": " << english;
            EXPECT_FALSE(translated.empty()) << language << ": " << english;
        }
}

TEST(Translation, KeepTheNumbersOfWhatTheServerSays) {
    speak("de");
    EXPECT_EQ(tr_filled("that is 12 mm away from the bone; choose a place within 100 mm of it"),
              "das ist 12 mm vom Knochen entfernt; wählen Sie eine Stelle höchstens 100 mm davon");
    EXPECT_EQ(tr_filled("nothing is left to undo"), "nichts ist mehr zurückzunehmen");
    EXPECT_EQ(tr_filled("no such text of -1.5 mm"), "no such text of -1.5 mm");
    speak("en");
    EXPECT_EQ(tr_filled("that is 12 mm away"), "that is 12 mm away");
}

TEST(Translation, NameNoOptionOfAProgram) {
    for (const std::string& english : english_words())
        EXPECT_FALSE(english.find("--") != std::string::npos ||
                     english.find("haptic_server") != std::string::npos)
            << "a trainee at the window has no command line: " << english;
}

TEST(FaultRemedies, AreOfEachFaultThatTheServerWords) {
    for (const Fault fault : all_faults) {
        if (fault == Fault::paused) continue;  // which is shown unchanged
        EXPECT_NE(std::string(remedy_of(describe(fault))), remedy_of("another")) << describe(fault);
    }
}

TEST(Translation, AreEnglishUntilAnotherLanguageIsSpoken) {
    EXPECT_STREQ(tr("Finish"), "Finish");
    speak("de");
    EXPECT_STREQ(tr("Finish"), "Beenden");
    EXPECT_EQ(trf("depth {:.2f} mm", 1.234), "Tiefe 1,23 mm");
    EXPECT_EQ(trf("{:.0f} million voxels, {:.0f} MB at most, some {:.0f} s (estimated)", 1.0, 2.0, 3.0F),
              "1 Millionen Voxel, höchstens 2 MB, etwa 3 s (geschätzt)");
    EXPECT_EQ(trf("cannot reach {}: {}", "127.0.0.1:9999", "v1.5"),
              "127.0.0.1:9999 ist nicht zu erreichen: v1.5")
        << "names keep their points";
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
