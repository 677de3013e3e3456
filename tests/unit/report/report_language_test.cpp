// The report in another language: every text has its translation, and nothing else changes.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "analysis/report/write_report.h"
#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "common/words/translation.h"
#include "tests/support/ball_structure.h"
#include "tests/support/has_word.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// Names and notes that a person gave, and settings: the same in each language.
bool is_a_name(const std::string& text) {
    static const std::set<std::string> given{"Osteomill: Anna", "coupling", "contact", "device", "client"};
    if (text.starts_with("at ") || text == "of") return false;  // short words
    return given.contains(text) || text.find("Notiz") != std::string::npos || !testing::has_word(text);
}

/// The texts between the tags of a page's body, and its title.
std::vector<std::string> texts_of(const std::string& page) {
    static const std::regex style("<style>[^<]*</style>");
    static const std::regex text(">([^<>]*)<");
    const std::string shown =
        std::regex_replace(std::regex_replace(page, style, ""), std::regex("&#39;"), "'");
    std::vector<std::string> texts;
    for (std::sregex_iterator found(shown.begin(), shown.end(), text), end; found != end; ++found)
        if (found->str(1).find_first_not_of(" \n") != std::string::npos) texts.push_back(found->str(1));
    return texts;
}

std::vector<std::string> all_of(const std::string& text, const char* pattern) {
    const std::regex wanted(pattern);
    return {std::sregex_token_iterator(text.begin(), text.end(), wanted), {}};
}

/// Numbers with that decimal sign, and those that a person gave, written with a point.
std::vector<std::string> numbers_of(const std::string& text, char decimal_sign) {
    std::vector<std::string> numbers =
        all_of(text, decimal_sign == '.' ? R"(\d+(\.\d+)?)" : R"(\d+([.,]\d+)?)");
    for (std::string& number : numbers) std::ranges::replace(number, decimal_sign, '.');
    return numbers;
}

/// A text without the date and time that each language writes in its own way.
std::string without_date(const std::string& text) {
    return std::regex_replace(
        text, std::regex(R"(\d{4}-\d\d-\d\d \d\d:\d\d \w+|\d\d\.\d\d\.\d{4}, \d\d:\d\d Uhr)"), "then");
}

/// A text without its numbers.
std::string words_of(const std::string& text) {
    return std::regex_replace(text, std::regex(R"(\d+([.,]\d+)?)"), "0");
}

class ReportLanguage : public ::testing::Test {
  protected:
    void TearDown() override { speak("en"); }

    /// The jaw's tissues, burrs, plan, marks and rating on a cube, with its pulp at the top.
    SessionInfo jaw() const {
        const auto shipped = std::ranges::find(shipped_scenes, "jaw", &ShippedScene::name);
        const Scene scene = parse_scene(shipped->text, "jaw");
        return {.scene_name = "jaw",
                .server_version = "0.3",
                .burrs = scene.burrs,
                .tissues = scene.tissues,
                .plan = scene.plan,
                .pass = scene.pass,
                .rating = scene.rating,
                .trainee = "Anna",
                .case_name = "jaw",
                .settings = {{"coupling", "contact"}, {"device", "client"}}};
    }
    /// Cuts the pulp, undoes some of it, marks a moment, is refused something.
    void write(const std::string& name, const SessionInfo& session) const {
        const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3& place) {
            return static_cast<std::uint8_t>(place.z > 3.0 ? 5 : place.z > 0.0 ? 7 : 3);
        });
        testing::WrittenSession written(folder_ / name, session, bone);
        ToolState tool{.burr_position_mm = {0.0, 0.0, 6.0}, .hand_position_mm = {0.0, 0.0, 6.0}};
        const auto frames = [&](int count, double force_n) {
            for (int i = 0; i < count; ++i) {
                tool.force_n = {0.0, 0.0, force_n};
                tool.spindle_on = force_n > 0.0;
                tool.burr_position_mm.x = tool.hand_position_mm.x = 0.1 * (i % 7) * (i % 3);
                tool.burr_position_mm.z = tool.hand_position_mm.z = 6.0 - 0.1 * i;
                written.frame(tool);
                tool.time_s += 0.05;
            }
        };
        frames(10, 0.0);
        for (const double top : {3.5, 3.0}) {
            written.cut([&](const glm::dvec3& place) { return place.z > top; });
            frames(20, 2.5);
            frames(10, 0.0);
        }
        written.event({.time_s = tool.time_s, .action = SessionAction::mark, .text = "Notiz, with words"});
        written.event({.time_s = tool.time_s, .action = SessionAction::undo, .text = "12.50 mm³"});
        written.restore([](const glm::dvec3& place) { return place.z > 3.5; });
        frames(10, 0.0);
        written.event({.time_s = tool.time_s,
                       .action = SessionAction::save,
                       .text = "the last one is still being saved",
                       .is_refused = true});
        written.event(
            {.time_s = tool.time_s, .action = SessionAction::place, .text = "at 1.0, -2.5, 3.0 mm LPS"});
        written.event({.time_s = tool.time_s, .action = SessionAction::speed, .text = "each burr's own"});
        frames(2, 0.0);
        written.finish();
    }
    std::string page(const std::string& name, const std::string& language) const {
        speak(language);
        (void)write_report(folder_ / name, folder_ / "reports" / name, [](double) {});
        return testing::bytes_of(folder_ / "reports" / name / "report.html");
    }
    /// Every text has another in the other language, unless it is a name, with the same numbers; and what
    /// has no words is the same.
    void expect_all_translated(const std::string& name) const {
        const std::string english = page(name, "en");
        const std::string german = page(name, "de");
        EXPECT_THAT(english, HasSubstr("<html lang='en'>"));
        EXPECT_THAT(german, HasSubstr("<html lang='de'>"));
        const char* const pictures = "src='data:[^']*'";
        EXPECT_EQ(all_of(english, pictures), all_of(german, pictures));
        const char* const curves = "points='[^']*'";
        EXPECT_EQ(all_of(english, curves), all_of(german, curves));
        const std::vector<std::string> before = texts_of(english);
        const std::vector<std::string> after = texts_of(german);
        ASSERT_EQ(before.size(), after.size());
        EXPECT_GT(before.size(), 100U);
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_EQ(numbers_of(without_date(before[i]), '.'), numbers_of(without_date(after[i]), ','))
                << before[i];
            if (is_a_name(before[i]))
                EXPECT_EQ(words_of(before[i]), words_of(after[i]));
            else
                EXPECT_NE(before[i], after[i]);
        }
    }

    testing::TemporaryFolder folder_;
};

TEST_F(ReportLanguage, IsOfEveryTextOfAJudgedAndRatedSession) {
    SessionInfo session = jaw();
    session.burrs.front().name = "1.5 mm";
    write("anna", session);
    expect_all_translated("anna");
    const std::string german = page("anna", "de");
    EXPECT_THAT(german, HasSubstr("<b>Eröffnet: Pulpa</b>"));
    EXPECT_THAT(german, HasSubstr("<b>Nicht bestanden</b>"));
    EXPECT_THAT(german, HasSubstr("<td>bei 1,0; -2,5; 3,0 mm LPS</td>"));
    EXPECT_THAT(german, HasSubstr("abgetragener Anteil des Plans ≥ 50 % und Berührungen (Pulpa) = 0"));
    EXPECT_THAT(german, HasSubstr("<b>4,05 s</b>"));
    EXPECT_THAT(german, HasSubstr("<td>1,5 mm</td>"));
}

TEST_F(ReportLanguage, IsOfEveryTextBesideTheExpertsSessions) {
    SessionInfo session = jaw();
    session.pass = {{"peak_force_n", 3.0}};
    write("anna", session);
    (void)page("anna", "en");
    for (const char* const other : {"b", "c", "d", "e"}) {
        auto json = nlohmann::json::parse(testing::bytes_of(folder_ / "reports/anna/metrics.json"));
        json["session"]["trainee"] = other;
        std::filesystem::create_directories(folder_ / "reports" / other);
        std::ofstream(folder_ / "reports" / other / "metrics.json") << json;
    }
    expect_all_translated("anna");
    EXPECT_THAT(page("anna", "de"), HasSubstr("mittlere Hälfte der anderen (4)"));
    std::ofstream(folder_ / "reports/groups.csv") << "b,expert\nc,expert\nd,expert\ne,expert\n";
    expect_all_translated("anna");
    EXPECT_THAT(page("anna", "de"), HasSubstr("mittlere Hälfte der Experten (4)"));
    EXPECT_THAT(page("anna", "de"), HasSubstr("<b>Bestanden</b>"));
}

TEST_F(ReportLanguage, IsOfEveryTextOfWhatIsLeftOfARecording) {
    write("anna", jaw());
    const auto bytes = std::filesystem::file_size(folder_ / "anna");
    std::filesystem::resize_file(folder_ / "anna", bytes - 200);
    expect_all_translated("anna");
    EXPECT_THAT(page("anna", "de"), HasSubstr("Die Aufzeichnung endet vor der Sitzung"));
}

TEST_F(ReportLanguage, RoundsTheLengthsOfThePlan) {
    SessionInfo session = jaw();
    session.plan =
        Plan{.region =
                 CylinderRegion{.from_mm = {0.0, 0.0, 0.0}, .to_mm = {1.0, 1.0, 4.0}, .radius_mm = 1.0 / 3.0},
             .margin_mm = 0.5};
    write("anna", session);
    expect_all_translated("anna");
    EXPECT_THAT(page("anna", "de"),
                HasSubstr("ein Zylinder mit 0,333 mm Radius, 4,24 mm lang, mit einem Rand von 0,5 mm"));
}

TEST_F(ReportLanguage, IsOfEveryTextWithoutPlanMarksOrTissues) {
    write("anna", {.scene_name = "cube", .burrs = {Burr{}}, .trainee = "Anna"});
    expect_all_translated("anna");
    EXPECT_THAT(page("anna", "de"), HasSubstr("Würfel"));
}

TEST_F(ReportLanguage, ChangesNoNumberOfItsTables) {
    write("anna", jaw());
    (void)page("anna", "en");
    const std::string csv = testing::bytes_of(folder_ / "reports/anna/metrics.csv");
    const std::string json = testing::bytes_of(folder_ / "reports/anna/metrics.json");
    (void)page("anna", "de");
    EXPECT_EQ(testing::bytes_of(folder_ / "reports/anna/metrics.csv"), csv);
    EXPECT_EQ(testing::bytes_of(folder_ / "reports/anna/metrics.json"), json);
}

}  // namespace
}  // namespace osteomill
