#include "render_client/ui/start/kept_sessions.h"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <time.h>

#include <chrono>
#include <fstream>

#include "common/files/output_place.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

void write(const std::filesystem::path& file, const std::string& text = "x") {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

TEST(KeptSessions, AreTheNewestFirstAndThoseThatWereEndedInTheMiddleToo) {
    const testing::TemporaryFolder folder;
    write(folder / "a/session.pcap");
    write(folder / "b/session.pcap");
    write(folder / "b/report.html");
    write(folder / "killed/session.part.pcap");
    write(folder / "nothing/bone.nrrd");
    const auto now = std::filesystem::last_write_time(folder / "b/session.pcap");
    std::filesystem::last_write_time(folder / "a/session.pcap", now - std::chrono::hours(1));
    std::filesystem::last_write_time(folder / "killed/session.part.pcap", now - std::chrono::hours(2));
    const auto sessions = sessions_in(folder / ".");
    ASSERT_EQ(sessions.size(), 3U);
    EXPECT_EQ(sessions[0].folder.filename(), "b");
    EXPECT_TRUE(sessions[0].has_report);
    EXPECT_TRUE(sessions[1].is_whole);
    EXPECT_FALSE(sessions[1].has_report);
    EXPECT_FALSE(sessions[2].is_whole);
    EXPECT_EQ(sessions[2].recording.filename(), "session.part.pcap");
    EXPECT_TRUE(sessions_in(folder / "nowhere").empty());
}

TEST(KeptSessions, AreUnderWayUntilTheReportIsWritten) {
    const testing::TemporaryFolder folder;
    write(folder / "a/session.pcap");
    {
        const OutputPlace report(folder / "a/report.html");
        EXPECT_TRUE(sessions_in(folder / ".").at(0).is_under_way);
    }
    EXPECT_FALSE(sessions_in(folder / ".").at(0).is_under_way);
}

TEST(KeptSessions, HaveNamesAsAPersonWritesThem) {
    const testing::TemporaryFolder folder;
    const auto named = folder / "jaw-anna_b-20261128-140509";
    write(named / "session.pcap");
    EXPECT_EQ(title_of_session(named), "anna_b, jaw, 28 November 14:05") << "without a report";
    write(
        named / "metrics.json",
        R"({"session": {"trainee": "Anna B.", "case": "jaw", "scene": "jaw"}, "metrics": {"passed": 0.0}})");
    EXPECT_EQ(title_of_session(named), "Anna B., jaw, 28 November 14:05, not passed");
    write(named / "metrics.json", R"({"session": {"trainee": "Bo", "case": "jaw", "scene": "jaw"},
        "metrics": {"rating_points": 14.5, "rating_most_points": 20, "undos": 3, "passed": 1}})");
    EXPECT_EQ(title_of_session(named),
              "Bo, jaw, 28 November 14:05, passed, 14.5 of 20 points (undone 3 times)");
    write(named / "metrics.json", R"({"session": {"trainee": "Bo", "case": "jaw", "scene": "jaw"},
        "metrics": {"rating_points": 17, "rating_most_points": 20, "undos": 1}})");
    EXPECT_EQ(title_of_session(named), "Bo, jaw, 28 November 14:05, 17 of 20 points (undone once)");
    write(named / "metrics.json", R"({"session": {"trainee": "Bo", "case": "jaw", "scene": "jaw"},
        "metrics": {"rating_points": 20, "rating_most_points": 20, "undos": 0}})");
    EXPECT_EQ(title_of_session(named), "Bo, jaw, 28 November 14:05, 20 of 20 points");
    write(named / "metrics.json",
          R"({"session": {"trainee": "", "case": "", "scene": "tooth"}, "metrics": {}})");
    EXPECT_EQ(title_of_session(named), "nobody, tooth, 28 November 14:05");
    ::setenv("TZ", "LAB-1", 1);  // an hour east
    ::tzset();
    write(named / "metrics.json",
          R"({"session": {"trainee": "Bo", "case": "jaw", "scene": "jaw", "began": "2026-11-30 23:30 UTC"},
          "metrics": {}})");
    EXPECT_EQ(title_of_session(named), "Bo, jaw, 1 December 00:30") << "the report's time";
    ::unsetenv("TZ");
    ::tzset();
    write(named / "metrics.json", R"({"session": {"trainee": "Bo", "case": "jaw", "scene": "jaw",
        "began": "yesterday"}, "metrics": {}})");
    EXPECT_EQ(title_of_session(named), "Bo, jaw, 28 November 14:05");
    write(named / "metrics.json", R"({"session": "hostile)");
    EXPECT_EQ(title_of_session(named), "anna_b, jaw, 28 November 14:05");
    EXPECT_EQ(title_of_session(folder / "jaw-x-20261399-140509"), "jaw-x-20261399-140509");
    EXPECT_EQ(title_of_session(folder / "kept by hand"), "kept by hand");
    EXPECT_EQ(title_of_session(folder / "tooth-nobody-20261128-140509"), "nobody, tooth, 28 November 14:05");
    EXPECT_EQ(title_of_session(folder / "left-jaw-bo-20261128-140509"), "left-jaw-bo, 28 November 14:05");
}

}  // namespace
}  // namespace osteomill
