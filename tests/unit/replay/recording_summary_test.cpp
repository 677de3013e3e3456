#include "analysis/replay/recording_summary.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "analysis/replay/recording_csv.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using testing::MadeRecording;

double removed_of_tissue_mm3(const MadeRecording& made, std::size_t label) {
    return bone_volume_by_tissue_mm3(made.before)[label] - bone_volume_by_tissue_mm3(made.after)[label];
}

TEST(RecordingSummary, CountsWhatWasRemovedByTissue) {
    const testing::TemporaryFolder folder;
    const MadeRecording made = testing::make_recording(folder / "a.pcap");
    int states = 0;
    const RecordingSummary summary = summarise(folder / "a.pcap", [&](const Playhead&) { ++states; });
    EXPECT_EQ(states, 200);
    EXPECT_EQ(summary.states, 200U);
    EXPECT_NEAR(summary.duration_s, made.duration_s(), 1e-6);
    EXPECT_EQ(summary.bone_checksum, checksum(made.after));
    EXPECT_NEAR(summary.removed_mm3, bone_volume_mm3(made.before) - bone_volume_mm3(made.after), 1e-9);
    EXPECT_GT(summary.removed_mm3, 0.1);
    EXPECT_NEAR(summary.by_tissue_mm3.at("nerve"), removed_of_tissue_mm3(made, 2), 1e-9);
    EXPECT_NEAR(summary.by_tissue_mm3.at("unlabelled"), removed_of_tissue_mm3(made, 0), 1e-9);
    EXPECT_NEAR(summary.milled_s.at("round 5"), 0.5 * made.duration_s(), 2.0 * MadeRecording::period_s);
    EXPECT_TRUE(summary.has_goodbye);
    EXPECT_EQ(summary.error, "");

    const nlohmann::ordered_json json = to_json(summary);
    EXPECT_EQ(json.at("frames"), summary.frames);
    EXPECT_EQ(json.at("protocol"), "2.3");
    EXPECT_EQ(json.at("bone_checksum").get<std::string>().size(), 16U);
    EXPECT_EQ(json.at("removed_mm3").at("total"), summary.removed_mm3);
    EXPECT_EQ(json.at("removed_mm3").at("nerve"), summary.by_tissue_mm3.at("nerve"));
    EXPECT_NEAR(json.at("duration_s").get<double>(), made.duration_s(), 1e-6);
    EXPECT_THAT(to_text(summary), HasSubstr("nerve"));
}

TEST(RecordingSummary, AddsUpTheSessionsOfAJoinedRecording) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap", {.states = 50, .ends = false});
    testing::make_recording(folder / "b.pcap", {.states = 30, .seed = 9});
    testing::join(folder / "a.pcap", folder / "b.pcap", folder / "both.pcap");
    const auto nothing = [](const Playhead&) {};
    const RecordingSummary first = summarise(folder / "a.pcap", nothing);
    const RecordingSummary second = summarise(folder / "b.pcap", nothing);
    const RecordingSummary both = summarise(folder / "both.pcap", nothing);
    EXPECT_FALSE(first.has_goodbye);
    EXPECT_EQ(both.sessions, 2U);
    EXPECT_NEAR(both.removed_mm3, first.removed_mm3 + second.removed_mm3, 1e-9);
    EXPECT_NEAR(both.duration_s, first.duration_s + second.duration_s, 1e-6);
    EXPECT_EQ(both.bone_checksum, second.bone_checksum);
}

TEST(RecordingSummary, HoldsWhatCameBeforeWhatCannotBeRead) {
    const testing::TemporaryFolder folder;
    const MadeRecording made = testing::make_recording(folder / "a.pcap");
    testing::spoil(folder / "a.pcap", 19);
    double last_s = 0.0;
    const RecordingSummary summary =
        summarise(folder / "a.pcap", [&](const Playhead& playhead) { last_s = playhead.time_s(); });
    EXPECT_THAT(summary.error, HasSubstr("a.pcap, packet "));
    EXPECT_EQ(summary.states, 181U) << "the last 19 and the end are lost";
    EXPECT_EQ(summary.bone_checksum, made.checksum_after_state[180]);
    EXPECT_NEAR(last_s, 180 * MadeRecording::period_s, 1e-6);
    Playhead playhead(folder / "a.pcap");
    while (playhead.step(last_s) == Playhead::Step::state && playhead.counts().states < summary.states) {
    }
    EXPECT_NEAR(summary.removed_mm3, bone_volume_mm3(made.before) - bone_volume_mm3(playhead.bone()), 1e-9);
}

TEST(RecordingCsv, HasALineForEachStateUnderItsHeader) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap", {.states = 20});
    RecordingCsv csv(folder / "a.csv", CsvLines::states);
    summarise(folder / "a.pcap", [&](const Playhead& playhead) { csv.add(playhead); });
    csv.close();
    std::istringstream lines(testing::bytes_of(folder / "a.csv"));
    std::string header;
    std::getline(lines, header);
    const auto columns = std::count(header.begin(), header.end(), ',');
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns);
        const std::string time_s = fmt::format("{:.4f}", MadeRecording::period_s * count);
        EXPECT_THAT(line, ::testing::StartsWith(time_s + "," + time_s + ","));
        EXPECT_THAT(line, HasSubstr(",round 5,"));
    }
    EXPECT_EQ(count, 20);
    EXPECT_THROW(RecordingCsv("/nowhere/a.csv", CsvLines::ticks), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
