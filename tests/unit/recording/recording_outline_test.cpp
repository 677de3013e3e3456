#include <gmock/gmock.h>

#include "common/recording/pcap_file.h"
#include "common/recording/recording_reader.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using Kind = RecordedMoment::Kind;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Field;
using testing::MadeRecording;

auto moment(double time_s, Kind kind) {
    return AllOf(Field(&RecordedMoment::time_s, DoubleNear(time_s, 1e-6)),
                 Field(&RecordedMoment::kind, kind));
}

/// Marks at 0.5 s and, refused, at 1 s; a nerve is touched at 2 s and again at 4 s.
testing::MadeRecordingOptions eventful() {
    return {.states = 100,
            .distances =
                [](int i) {
                    const StructureDistance nerve{
                        .tissue = 0, .touches_so_far = (i >= 40 ? 1U : 0U) + (i >= 80 ? 1U : 0U)};
                    return std::vector{nerve};
                },
            .events =
                [](int i) {
                    std::vector<ControlEvent> events;
                    if (i == 10) events.push_back({.action = SessionAction::mark, .text = "here"});
                    if (i == 20) events.push_back({.action = SessionAction::mark, .is_refused = true});
                    if (i == 30) events.push_back({.action = SessionAction::pause});
                    return events;
                }};
}

TEST(RecordingOutline, HasMarksAndTheBeginningOfEachTouch) {
    const testing::TemporaryFolder folder;
    const MadeRecording made = testing::make_recording(folder / "a.pcap", eventful());
    const RecordingOutline outline = outline_of(folder / "a.pcap");
    EXPECT_NEAR(outline.duration_s, made.duration_s(), 1e-6);
    EXPECT_THAT(outline.moments,
                ElementsAre(moment(0.5, Kind::mark), moment(2.0, Kind::touch), moment(4.0, Kind::touch)));
}

TEST(RecordingOutline, CountsEachSessionsTouchesAnew) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap", eventful());
    testing::join(folder / "a.pcap", folder / "a.pcap", folder / "both.pcap");
    EXPECT_EQ(outline_of(folder / "both.pcap").moments.size(), 6U);
}

TEST(RecordingOutline, EndsWhereTheFileIsSpoilt) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap", eventful());
    testing::spoil(folder / "a.pcap", 40);
    EXPECT_THAT(outline_of(folder / "a.pcap").moments,
                ElementsAre(moment(0.5, Kind::mark), moment(2.0, Kind::touch)));
    EXPECT_THROW(outline_of("/nowhere/a.pcap"), RecordingError);
}

}  // namespace
}  // namespace osteomill
