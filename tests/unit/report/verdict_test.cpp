#include <gmock/gmock.h>

#include <fstream>

#include "analysis/report/metrics_csv_json.h"
#include "analysis/report/reference_sessions.h"
#include "analysis/report/report_html.h"
#include "analysis/report/session_metrics.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<MetricRow> rows{{"", "time_s", "", "", 100.0, "s"},
                                  {"", "plan_removed_share", "", "", 0.8, ""},
                                  {"", "structure_touches", "nerve", "", 1.0, ""},
                                  {"", "structure_touches", "dura", "", 2.0, ""}};

TEST(VerdictTest, PassesWhatReachesEveryMark) {
    const auto passes = [](const PassMarks& marks) { return has_passed(judged_marks(marks, rows)); };
    EXPECT_FALSE(passes({}).has_value());
    EXPECT_EQ(passes({{"time_s", 100.0}, {"plan_removed_share", 0.8}}), true) << "the mark itself passes";
    EXPECT_EQ(passes({{"time_s", 99.9}, {"plan_removed_share", 0.8}}), false);
    EXPECT_EQ(passes({{"plan_removed_share", 0.81}}), false);
    EXPECT_EQ(passes({{"structure_touches", 3.0}}), true);
    EXPECT_EQ(passes({{"structure_touches", 2.0}}), false) << "touches of all structures count";
    EXPECT_EQ(passes({{"peak_force_n", 5.0}}), false) << "what was not measured reaches no mark";
}

class Judged : public ::testing::Test {
  protected:
    /// A cube of 8 mm of which all above z = 3 goes, 64 of 512 mm^3, in `time_s`.
    void report(const std::string& name, const std::string& trainee, double time_s, bool is_whole = true,
                const std::string& force_model = "voxels") {
        const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3&) { return std::uint8_t{1}; });
        const auto file = folder_ / (name + ".pcap");
        testing::WrittenSession written(file,
                                        {.scene_name = "cube",
                                         .burrs = {Burr{}},
                                         .tissues = {{.label = 1, .name = "lesion"}},
                                         .plan = Plan{.region = TissueRegion{"lesion"}},
                                         .pass = {{"time_s", 60.0}, {"plan_removed_share", 0.1}},
                                         .trainee = trainee,
                                         .settings = {{"force_model", force_model}}},
                                        bone);
        written.frame({.time_s = 0.0});
        written.cut([](const glm::dvec3& place) { return place.z > 3.0; });
        written.frame({.time_s = time_s, .spindle_on = true});
        written.finish();
        if (!is_whole) std::filesystem::resize_file(file, std::filesystem::file_size(file) - 200);
        const SessionTrace trace = read_trace(file, [](double) {});
        const SessionMetrics metrics = session_metrics(trace);
        const auto all_rows = metric_rows(metrics);
        const auto folder = folder_ / "all" / name;
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "metrics.json") << metrics_json(trace, all_rows);
        csv_ = metrics_csv(all_rows);
        page_ = report_html(trace, metrics, all_rows, {}, reference_sessions(folder, trace));
    }

    std::string csv_;  // the last report's
    std::string page_;
    testing::TemporaryFolder folder_;
};

TEST_F(Judged, SaysWhichMarksAreMissed) {
    report("fast", "Anna", 59.5);
    EXPECT_THAT(page_, HasSubstr("<b>Passed</b>All 2 marks"));
    EXPECT_THAT(page_, HasSubstr("✓ pass mark: at least 10 %"));
    EXPECT_THAT(csv_, HasSubstr("passed,,1,\n"));
    report("slow", "Anna", 61.25);
    EXPECT_THAT(page_, HasSubstr("<b>Not passed</b>time: 61.2 s, at most 60 s<"));
    EXPECT_THAT(csv_, HasSubstr("passed,,0,\n"));
    report("torn", "Anna", 61.25, false);
    EXPECT_THAT(page_, HasSubstr("<b>Not judged</b>"));
    EXPECT_THAT(csv_, Not(HasSubstr("passed")));
}

TEST_F(Judged, IsShownAgainstTheSessionsBesideIt) {
    for (int i = 0; i < 4; ++i) report("peer" + std::to_string(i), "Bo", 20.0 + 10.0 * i);
    report("own", "Anna", 50.0);
    // Quartiles of 20, 30, 40, 50 by definition 7: 27.5 and 42.5.
    EXPECT_THAT(page_, HasSubstr("others' middle half (4): 27.5 to 42.5 s"));
    report("again", "Anna", 50.0);
    EXPECT_THAT(page_, HasSubstr("others' middle half (4):")) << "it is no peer of its own";
    for (int i = 0; i < 4; ++i) report("other" + std::to_string(i), "Bo", 90.0, true, "point-spring");
    report("again", "Anna", 50.0);
    EXPECT_THAT(page_, HasSubstr("others' middle half (4): 27.5")) << "what feels otherwise is no reference";
    std::ofstream(folder_ / "all/groups.csv") << "trainee,group\nEva,expert\nBo,student\n";
    for (int i = 0; i < 4; ++i) report("expert" + std::to_string(i), "Eva", 10.0 + i);
    report("own", "Anna", 50.0);
    EXPECT_THAT(page_, HasSubstr("experts' middle half (4): 10.8 to 12.2 s"));
    std::ofstream(folder_ / "all/groups.csv") << "no group\n";
    report("own", "Anna", 50.0);
    EXPECT_THAT(page_, Not(HasSubstr("middle half"))) << "nobody knows who the experts are";
}

TEST(TraineeGroups, AreALineEach) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "groups.csv";
    const auto written = [&](const std::string& text) {
        std::ofstream(file) << text;
        std::map<std::string, std::string> groups;
        for (const auto& [trainee, found] : trainee_groups(file)) groups[trainee] = found.group;
        return groups;
    };
    const std::map<std::string, std::string> two{{"Anna, A.", "novice"}, {"Eva", "expert"}};
    EXPECT_EQ(written("trainee,group\nAnna, A.,novice\n\n Eva , expert \n"), two);
    EXPECT_EQ(written("Eva,expert\nAnna, A.,novice\nEva,expert\n"), two);
    EXPECT_EQ(written("\xef\xbb\xbftrainee,group\r\n\"Anna, A.\",\"novice\"\r\nEva,expert\r\n"), two)
        << "as Excel writes it";
    EXPECT_EQ(written("Anna, A.;novice\nEva;expert\n"), two);
    EXPECT_EQ(written("trainee,group\rAnna, A.,novice\rEva,expert\r"), two) << "as an old Mac ends lines";
    const std::map<std::string, std::string> german{{"J\xc3\xbcrgen \xe2\x80\x93", "expert"}};
    EXPECT_EQ(written("trainee;group\r\nJ\xfcrgen \x96;expert\r\n"), german) << "as German Excel saves a CSV";
    for (const char* word : {"Expert", "experts", "Experte", "EXPERTIN", "Experten"})
        EXPECT_EQ(written(std::string("Eva;") + word).at("Eva"), "expert") << word;
    EXPECT_EQ(written("Eva;expert in 2027").at("Eva"), "expert in 2027");
    std::ofstream(file) << "trainee,group\r\n\r\nEva,expert\r\n";
    EXPECT_EQ(trainee_groups(file).at("Eva"), (TraineeGroup{"expert", 3}));
    const auto error_of = [&](const std::string& text) {
        return testing::message_of<std::runtime_error>([&] { (void)written(text); });
    };
    EXPECT_THAT(error_of("Eva,expert\nAnna\n"), HasSubstr("groups.csv:2: a line is TRAINEE,GROUP"));
    EXPECT_THAT(error_of("trainee,group,note\nEva,expert,left-handed\n"),
                HasSubstr("groups.csv:1: has 3 columns"));
    EXPECT_THAT(error_of("Name;Gruppe;Jahr\nEva;Experte;2026\n"), HasSubstr("groups.csv:1: has 3 columns"));
    EXPECT_THAT(error_of("A., Anna;student\nEva;Experte;2026\n"), HasSubstr("groups.csv:2: has 3 columns"));
    EXPECT_THAT(error_of("Eva,\n"), HasSubstr("neither is empty"));
    EXPECT_THAT(error_of("Eva,expert\nEva,novice\n"), HasSubstr("\"Eva\" is in group \"expert\" already"));
}

}  // namespace
}  // namespace osteomill
