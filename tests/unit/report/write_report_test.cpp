#include "analysis/report/write_report.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/report/metrics_csv_json.h"
#include "common/recording/pcap_file.h"
#include "imaging/picture/bone_picture.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(WriteReport, ShowsHostileNamesAsTextInOnePage) {
    const testing::TemporaryFolder folder;
    const std::string hostile = "\"'><script src=http://x/y.js></script>";
    const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3&) { return std::uint8_t{1}; });
    testing::WrittenSession written(folder / "a.pcap",
                                    {.scene_name = hostile,
                                     .server_version = hostile,
                                     .burrs = {Burr{.name = hostile}},
                                     .tissues = {{.label = 1, .name = hostile, .is_protected = true}},
                                     .plan = Plan{.region = TissueRegion{hostile}},
                                     .trainee = hostile,
                                     .case_name = hostile,
                                     .settings = {{hostile, hostile}}},
                                    bone);
    written.frame({.time_s = 0.0});
    written.event({.time_s = 0.5, .action = SessionAction::mark, .text = hostile});
    written.cut([](const glm::dvec3& place) { return place.z > 3.0; });
    written.frame({.time_s = 1.0, .spindle_on = true});
    written.finish();
    EXPECT_EQ(write_report(folder / "a.pcap", folder / "report", [](double) {}), "");
    const std::string page = testing::bytes_of(folder / "report/report.html");
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, HasSubstr("&lt;script"));
    // On a narrow screen a table scrolls, and the page does not.
    const auto count_of = [&page](const std::string& wanted) {
        std::size_t count = 0;
        for (std::size_t at = page.find(wanted); at != std::string::npos; at = page.find(wanted, at + 1))
            ++count;
        return count;
    };
    EXPECT_GT(count_of("<table"), 3U);
    EXPECT_EQ(count_of("<table"), count_of("<div class='scroll'><table"));
    EXPECT_EQ(count_of("</table>"), count_of("</table></div>"));
    EXPECT_THAT(page, HasSubstr(".scroll{overflow-x:auto"));
    // On paper a browser shrinks the whole page to its widest line: a long setting breaks anywhere.
    EXPECT_THAT(page, HasSubstr("td.setting{overflow-wrap:anywhere}"));
    EXPECT_EQ(count_of("<td class='setting'>"), 1U);
    EXPECT_THAT(page, Not(HasSubstr("href=")));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
    const auto json = nlohmann::json::parse(testing::bytes_of(folder / "report/metrics.json"));
    EXPECT_EQ(json.at("metrics").at("plan_removed_share"),
              json.at("metrics").at("removed_mm3").get<double>() / 512.0);
    EXPECT_THAT(testing::bytes_of(folder / "report/metrics.csv"), HasSubstr("\"\"\"'><script"));
}

TEST(WriteReport, ItsTilesSayWhatItsTablesSay) {
    const testing::TemporaryFolder folder;
    const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3&) { return std::uint8_t{1}; });
    testing::WrittenSession written(folder / "a.pcap", {.scene_name = "cube", .burrs = {Burr{}}}, bone);
    written.frame({.time_s = 0.0});
    written.frame({.time_s = 155.74, .force_n = {0.0, 3.0, 4.123}});
    written.finish();
    EXPECT_EQ(write_report(folder / "a.pcap", folder / "report", [](double) {}), "");
    const std::string page = testing::bytes_of(folder / "report/report.html");
    EXPECT_THAT(page, HasSubstr("<b>155.7 s</b>"));
    EXPECT_THAT(page, HasSubstr("<td class='n'>155.7</td><td class='u'>s</td>"));
    EXPECT_THAT(page, HasSubstr("<b>5.10 N</b>"));
    EXPECT_THAT(page, HasSubstr("<td class='n'>5.10</td><td class='u'>N</td>"));
}

TEST(WriteReport, SaysFirstWhatWasOpened) {
    const testing::TemporaryFolder folder;
    const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3&) { return std::uint8_t{1}; });
    testing::WrittenSession written(folder / "a.pcap",
                                    {.scene_name = "cube",
                                     .burrs = {Burr{}},
                                     .tissues = {{.label = 1, .name = "pulp", .is_protected = true}}},
                                    bone);
    written.frame({.time_s = 0.0, .burr_position_mm = {50.0, 0.0, 0.0}});
    written.cut([](const glm::dvec3& place) { return place.z > 3.0; });
    written.frame({.time_s = 1.0, .burr_position_mm = {50.0, 0.0, 0.0}, .spindle_on = true});
    written.finish();
    EXPECT_EQ(write_report(folder / "a.pcap", folder / "report", [](double) {}), "");
    const std::string page = testing::bytes_of(folder / "report/report.html");
    const auto opened = page.find("<div class='verdict failed'><b>Opened: pulp</b>64 mm³ of it milled</div>");
    ASSERT_NE(opened, std::string::npos);
    EXPECT_LT(opened, page.find("No pass marks are set"));
    EXPECT_THAT(page, HasSubstr("<div class='tile missed'><span>touches of protected structures"));
}

TEST(WriteReport, CallsAStructureOpenedOnlyIfItWasMilled) {
    const testing::TemporaryFolder folder;
    const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3& place) {
        return static_cast<std::uint8_t>(place.x > 1.0 ? 1 : place.x < -1.0 ? 2 : 3);
    });
    testing::WrittenSession written(folder / "a.pcap",
                                    {.scene_name = "cube",
                                     .burrs = {Burr{}},
                                     .tissues = {{.label = 1, .name = "nerve", .is_protected = true},
                                                 {.label = 2, .name = "dura", .is_protected = true},
                                                 {.label = 3, .name = "pulp", .is_protected = true}}},
                                    bone);
    double time_s = 0.0;
    const auto at = [&](const glm::dvec3& place_mm, bool turns) {
        written.frame({.time_s = time_s += 0.1, .burr_position_mm = place_mm, .spindle_on = turns});
    };
    at({50.0, 0.0, 0.0}, false);
    at({3.0, 0.0, 0.0}, false);  // as after a fault: the spindle is off
    at({-3.0, 0.0, 0.0}, true);
    at({50.0, 0.0, 0.0}, false);
    written.cut([](const glm::dvec3& place) { return std::abs(place.x) < 1.0 && place.z > 3.0; });
    at({50.0, 0.0, 0.0}, true);
    written.finish();
    EXPECT_EQ(write_report(folder / "a.pcap", folder / "report", [](double) {}), "");
    const std::string page = testing::bytes_of(folder / "report/report.html");
    const auto opened = page.find("<div class='verdict failed'><b>Opened: pulp</b>");
    const auto entered = page.find("<div class='verdict failed'><b>Entered by the turning burr: dura</b>");
    const auto touched = page.find("<div class='verdict touched'><b>Touched, nothing cut: nerve</b>");
    ASSERT_NE(touched, std::string::npos);
    EXPECT_LT(opened, entered);
    EXPECT_LT(entered, touched);
    EXPECT_THAT(page, Not(HasSubstr("Opened: nerve")));
}

TEST(WriteReport, OfATornRecordingIsOfWhatCanBeRead) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap");
    testing::spoil(folder / "a.pcap", 20);
    EXPECT_THAT(write_report(folder / "a.pcap", folder / "report", [](double) {}),
                HasSubstr("a.pcap, packet "));
    EXPECT_THAT(testing::bytes_of(folder / "report/report.html"), HasSubstr("could not be read to its end"));
    std::filesystem::resize_file(folder / "a.pcap", 100);
    EXPECT_THROW((void)write_report(folder / "a.pcap", folder / "other", [](double) {}), RecordingError);
    EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

TEST(WriteReport, SaysHowFarItIsAndLeavesNothingWhenStopped) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap");
    std::vector<double> done;
    EXPECT_EQ(
        write_report(folder / "a.pcap", folder / "report", [&](double share) { done.push_back(share); }), "");
    EXPECT_TRUE(std::ranges::is_sorted(done));
    EXPECT_GE(done.front(), 0.0);
    EXPECT_EQ(done.back(), 1.0);
    const auto stop = [](double share) {
        if (share > 0.3) throw std::runtime_error("stopped");
    };
    EXPECT_THROW((void)write_report(folder / "a.pcap", folder / "stopped", stop), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder / "stopped"));
}

TEST(WriteReport, SaysWhereTheSessionsEndIsMissing) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "whole.pcap");
    testing::make_recording(folder / "cut.pcap");
    std::filesystem::resize_file(folder / "cut.pcap", std::filesystem::file_size(folder / "cut.pcap") - 200);
    for (const std::string name : {"whole", "cut"}) {
        EXPECT_EQ(write_report(folder / (name + ".pcap"), folder / name, [](double) {}), "");
        const bool is_whole = name == "whole";
        const auto json = nlohmann::json::parse(testing::bytes_of(folder / name / "metrics.json"));
        EXPECT_EQ(json.at("is_complete"), is_whole);
        EXPECT_TRUE(json.at("error").is_null());
        const auto has_warning = HasSubstr("ends before the session does");
        const std::string page = testing::bytes_of(folder / name / "report.html");
        if (is_whole)
            EXPECT_THAT(page, Not(has_warning));
        else
            EXPECT_THAT(page, has_warning);
    }
}

TEST(WriteReport, CountsWhatTheBoneLost) {
    const testing::TemporaryFolder folder;
    const testing::MadeRecording made = testing::make_recording(folder / "a.pcap");
    const SessionTrace trace = read_trace(folder / "a.pcap", [](double) {});
    EXPECT_NEAR(session_metrics(trace).removal.removed_mm3,
                bone_volume_mm3(made.before) - bone_volume_mm3(made.after), 1e-9);
    EXPECT_EQ(trace.bone_checksum, checksum(made.after));
}

TEST(BoneViewTest, ShowsACubeAsASquare) {
    const Bone cube = testing::labelled_cube(2, 0.2, [](const glm::dvec3&) { return std::uint8_t{1}; });
    const RgbPicture picture = picture_of(cube, {}, {.half_width_mm = 6.4}, 32);
    ASSERT_EQ(picture.rgb.size(), 32u * 32u * 3u);
    // The cube is 6.4 mm wide, the picture 12.8: the middle half of each row and column is bone.
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column) {
            const bool is_bone = row >= 8 && row < 24 && column >= 8 && column < 24;
            EXPECT_EQ(picture.rgb[static_cast<std::size_t>(3 * (32 * row + column))] < 250, is_bone)
                << row << ' ' << column;
        }
}

}  // namespace
}  // namespace osteomill
