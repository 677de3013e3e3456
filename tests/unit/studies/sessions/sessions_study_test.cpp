#include "analysis/sessions/sessions_study.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "analysis/sessions/overview.h"
#include "analysis/sessions/session_store.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill::study {
namespace {

using osteomill::testing::bytes_of;
using ::testing::HasSubstr;
using ::testing::Not;

/// A voxel of 1 mm^3 for each layer that is cut off a cube of 16 mm.
void write_session(const std::filesystem::path& file, const std::string& trainee, std::int64_t began_s,
                   int layers) {
    std::filesystem::create_directories(file.parent_path());
    const Bone bone =
        osteomill::testing::labelled_cube(1, 1.0, [](const glm::dvec3&) { return std::uint8_t{1}; });
    osteomill::testing::WrittenSession written(file,
                                               {.scene_name = "cube",
                                                .burrs = {Burr{.name = "small"}},
                                                .tissues = {{.label = 1, .name = "bone"}},
                                                .pass = {{"time_s", 3.0}},
                                                .trainee = trainee},
                                               bone);
    written.frame({.time_s = 0.0, .taken_unix_ns = began_s * 1'000'000'000});
    written.cut([&](const glm::dvec3& place) { return place.z > 8.0 - layers; });
    written.frame({.time_s = 1.0 + layers, .spindle_on = true});
    written.finish();
}

class SessionsStudy : public ::testing::Test {
  protected:
    SessionsStudy() {
        write_session(folder_ / "term/a2/session.pcap", "Anna", 2000, 2);
        write_session(folder_ / "term/a1/session.pcap", "Anna", 1000, 1);
        write_session(folder_ / "term/b/session.pcap", "<script>Bo", 1500, 4);
    }
    void run() {
        said_.str("");
        progress_.str("");
        run_sessions_study({.from = {folder_ / "term"}, .out = folder_ / "out", .version = "1"},
                           {.said = said_, .progress = progress_});
    }
    std::string text(const std::string& name) const { return bytes_of(folder_ / "out" / name); }

    osteomill::testing::TemporaryFolder folder_;
    std::ostringstream said_;
    std::ostringstream progress_;
};

TEST_F(SessionsStudy, WritesALineForEachSessionAndMetric) {
    run();
    EXPECT_THAT(said_.str(), HasSubstr("3 sessions in "));
    const std::string csv = text("sessions.csv");
    EXPECT_THAT(csv,
                ::testing::StartsWith("session,trainee,case,attempt,began_unix_s,metric,of,value,unit\n"));
    EXPECT_THAT(csv, HasSubstr("a1/session.pcap,Anna,cube,1,1000,removed_mm3,,256,mm^3\n"));
    EXPECT_THAT(csv, HasSubstr("b/session.pcap,<script>Bo,cube,1,1500,removed_mm3,,1024,mm^3\n"));
    EXPECT_THAT(csv, HasSubstr("a2/session.pcap,Anna,cube,2,2000,removed_mm3,,512,mm^3\n"));
    EXPECT_THAT(csv, HasSubstr("Anna,cube,2,2000,removed_of_tissue_mm3,bone,512,mm^3\n"));
    EXPECT_THAT(csv, HasSubstr("Anna,cube,2,2000,time_s,,3,s\n"));
    const std::string page = text("sessions.html");
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;Bo"));
    EXPECT_THAT(text("removed_mm3.svg"), HasSubstr("<svg"));
}

TEST_F(SessionsStudy, LinksEachReportAndJudgesEachSession) {
    std::filesystem::create_directories(folder_ / "term/it's c");
    std::filesystem::rename(folder_ / "term/a2/session.pcap", folder_ / "term/it's c/session.pcap");
    std::ofstream(folder_ / "term/it's c/report.html") << "a report";
    run();
    const std::string page = text("sessions.html");
    EXPECT_THAT(page, HasSubstr("<a href='../term/it%27s%20c/report.html'>"));
    EXPECT_EQ(page.find("<a href", page.find("<a href") + 1), std::string::npos) << "the others have none";
    // Within 3 s: Anna's with 2 and 3 s, not Bo's with 5.
    EXPECT_THAT(text("sessions.csv"), HasSubstr("Anna,cube,2,2000,passed,,1,\n"));
    EXPECT_THAT(text("sessions.csv"), HasSubstr("Bo,cube,1,1500,passed,,0,\n"));
    EXPECT_THAT(page, HasSubstr("✗ no"));
    EXPECT_THAT(page, HasSubstr("cumulative sum"));
}

TEST_F(SessionsStudy, TakesTheGroupsThatLieBesideTheSessions) {
    std::ofstream(folder_ / "term/groups.csv") << "Anna,novice\n<script>Bo,expert\n";
    run();
    EXPECT_THAT(text("sessions.html"), HasSubstr("Anna (novice)"));
    EXPECT_THAT(text("sessions.html"), HasSubstr(">novice (n)<"));
    std::ofstream(folder_ / "term/groups.csv") << "Anna\n";
    EXPECT_THROW(run(), std::runtime_error);
}

/// Of ten trainees with a time each, those of session_statistics_test.cpp.
std::vector<SessionRecord> two_groups() {
    std::vector<SessionRecord> sessions;
    const auto add = [&](const char* group, double time_s) {
        sessions.push_back({.trainee = std::string(group) + std::to_string(sessions.size()),
                            .case_name = "molar",
                            .metrics = {{"", "time_s", "", "time", time_s, "s"}},
                            .group = group});
    };
    for (const double time_s : {155.7, 162.3, 149.0, 171.2, 158.8}) add("expert", time_s);
    for (const double time_s : {201.4, 188.9, 240.2, 195.0, 222.6, 210.7}) add("student", time_s);
    return sessions;
}

TEST(OverviewTest, ComparesTwoGroups) {
    const auto sessions = two_groups();
    const std::string page = Overview(sessions, {}).html({});
    // As scipy has it, see session_statistics_test.cpp. Experts do not count in the mean, nor in the trend.
    EXPECT_THAT(page, HasSubstr("<td>time (s)</td><td>lower is better</td><td class='n'>6</td>"));
    EXPECT_THAT(page, HasSubstr("<td class='n'>159.4 (5)</td><td class='n'>209.8 (6)</td>"
                                "<td class='n'>-50.4 [-70.7 to -30.1]</td><td class='n'>g -3.03</td>"
                                "<td class='n'>&lt; 0.001</td><td>Welch</td>"));
    EXPECT_THAT(page, HasSubstr("<td class='n'>155.7 to 162.3</td>")) << "the experts' quartiles";
    EXPECT_THROW(Overview(sessions, {"expert", "nobody"}), std::runtime_error);
}

TEST(OverviewTest, CountsATraineeOnceAndDrawsTheTrend) {
    std::vector<SessionRecord> sessions;
    for (const double time_s : {300.0, 251.0, 230.0, 222.0, 210.0})
        sessions.push_back(
            {.trainee = "Anna", .case_name = "molar", .metrics = {{"", "time_s", "", "time", time_s, "s"}}});
    sessions.push_back(
        {.trainee = "Bo", .case_name = "molar", .metrics = {{"", "time_s", "", "", 200.0, "s"}}});
    const std::string page = Overview(sessions, {}).html({});
    // Anna's mean is 242.6; of hers and Bo's 200 it is 221.3.
    EXPECT_THAT(page, HasSubstr("<td class='n'>2</td><td class='n'>221.3 ["));
    // Slope -55.1198 per factor e (scipy's linregress, see session_statistics_test.cpp), times ln 2.
    EXPECT_THAT(page, HasSubstr("<td class='n'>-38.2 ["));
    EXPECT_THAT(page, HasSubstr(">trend</text>"));
    const std::vector<CaseSessions> cases = cases_of(sessions);
    ASSERT_EQ(cases.size(), 1u);
    EXPECT_EQ(cases[0].attempts[4].number, 5);
    EXPECT_EQ(cases[0].attempts[5].number, 1);
}

TEST_F(SessionsStudy, NamesATornRecordingAndDoesTheRest) {
    const auto torn = folder_ / "term/b/session.pcap";
    std::filesystem::resize_file(torn, std::filesystem::file_size(torn) - 40);
    std::ofstream(folder_ / "term/notes.pcap") << "no recording";
    run();
    EXPECT_THAT(said_.str(), HasSubstr("2 sessions, 2 left out, in "));
    EXPECT_THAT(progress_.str(), HasSubstr("b/session.pcap"));
    EXPECT_THAT(progress_.str(), HasSubstr("notes.pcap"));
    EXPECT_THAT(text("sessions.html"), HasSubstr("Left out: "));
    EXPECT_THAT(text("sessions.csv"), Not(HasSubstr("Bo")));
}

TEST_F(SessionsStudy, GivesTheSameFromTheStoreAndWithoutIt) {
    run();
    const std::string csv = text("sessions.csv");
    const std::string page = text("sessions.html");
    run();
    EXPECT_EQ(text("sessions.csv"), csv);
    EXPECT_EQ(text("sessions.html"), page);
    std::filesystem::remove(folder_ / "out/sessions.sqlite");
    run();
    EXPECT_EQ(text("sessions.csv"), csv);
    std::ofstream(folder_ / "out/sessions.sqlite") << std::string(5000, 'x');
    run();
    EXPECT_EQ(text("sessions.csv"), csv);
}

TEST_F(SessionsStudy, RefusesWhatHoldsNoSession) {
    EXPECT_THROW(recordings_in({folder_ / "nowhere"}), std::runtime_error);
    std::filesystem::create_directories(folder_ / "empty");
    EXPECT_THROW(recordings_in({folder_ / "empty"}), std::runtime_error);
    EXPECT_EQ(recordings_in({folder_ / "term", folder_ / "term/b", folder_ / "term/b/session.pcap"}).size(),
              3u);
}

TEST(SessionStoreTest, KeepsARecordAsItIs) {
    const osteomill::testing::TemporaryFolder folder;
    const SessionRecord record{
        .digest = "d1",
        .file = "a'b.pcap",
        .trainee = "O'Neil; DROP TABLE session",
        .case_name = "molar",
        .began_unix_ns = 1'700'000'000'123'456'789,
        .metrics = {{"", "time_s", "", "time", 1.0 / 3.0, "s"}, {"", "nothing", "pulp", "", {}, ""}}};
    const auto same = [&](const std::optional<SessionRecord>& kept) {
        ASSERT_TRUE(kept);
        EXPECT_EQ(kept->trainee, record.trainee);
        EXPECT_EQ(kept->file, record.file);
        EXPECT_EQ(kept->began_unix_ns, record.began_unix_ns);
        ASSERT_EQ(kept->metrics.size(), 2u);
        EXPECT_EQ(kept->metrics[0].value, 1.0 / 3.0);
        EXPECT_EQ(kept->metrics[1].of, "pulp");
        EXPECT_FALSE(kept->metrics[1].value);
    };
    {
        SessionStore store(folder / "s.sqlite", "1");
        EXPECT_FALSE(store.find("d1"));
        store.keep(record);
        store.keep(record);
        same(store.find("d1"));
    }
    same(SessionStore(folder / "s.sqlite", "1").find("d1"));
    EXPECT_FALSE(SessionStore(folder / "s.sqlite", "2").find("d1")) << "another version measures otherwise";
    EXPECT_THROW(SessionStore(folder / "no/folder/s.sqlite", "1"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill::study
