#include "haptic_server/replay/recorded_session.h"

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::MadeRecording;

class RecordedSessionTest : public ::testing::Test {
  protected:
    RecordedSessionTest() : made_(testing::make_recording(folder_ / "a.pcap")) {}

    std::function<RecordedSession::Clock::time_point()> clock() {
        return [this] { return now_; };
    }
    void pass(double time_s) {
        now_ += std::chrono::duration_cast<RecordedSession::Clock::duration>(
            std::chrono::duration<double>(time_s));
    }
    std::uint64_t checksum_at(double time_s) const {
        return made_.checksum_after_state[static_cast<std::size_t>(time_s / MadeRecording::period_s + 0.01)];
    }

    testing::TemporaryFolder folder_;
    MadeRecording made_;
    RecordedSession::Clock::time_point now_{};
};

TEST_F(RecordedSessionTest, PlaysAtItsSpeedFromWhenTheFirstViewerComes) {
    Playhead playhead(folder_ / "a.pcap");
    BoneReplica mirror(playhead.bone());
    RecordedSession session(playhead, 2.0, clock());
    pass(5.0);
    session.update(mirror, 0);
    mirror.take_changes();
    EXPECT_EQ(mirror.checksum(), checksum(made_.before)) << "nobody looks on";
    session.update(mirror, 1);
    pass(1.0);
    EXPECT_NEAR(session.update(mirror, 1).tool.time_s, 2.0, 1e-6);
    EXPECT_FALSE(mirror.take_changes().empty());
    EXPECT_EQ(mirror.checksum(), checksum_at(2.0));
    pass(1.0);
    session.update(mirror, 0);
    mirror.take_changes();
    EXPECT_EQ(mirror.checksum(), checksum_at(4.0)) << "it does not wait for the second";
    EXPECT_FALSE(session.is_over());
    pass(100.0);
    session.update(mirror, 1);
    mirror.take_changes();
    EXPECT_TRUE(session.is_over());
    EXPECT_EQ(mirror.checksum(), checksum(made_.after));
    EXPECT_EQ(session.error(), "");
}

TEST_F(RecordedSessionTest, ShowsTheFirstToolBeforeItsFirstState) {
    Playhead playhead(folder_ / "a.pcap");
    ASSERT_FALSE(playhead.tool());
    BoneReplica mirror(playhead.bone());
    RecordedSession session(playhead, 1.0, clock());
    EXPECT_EQ(session.update(mirror, 0).tool.burr, 1U) << "as recorded";
}

TEST_F(RecordedSessionTest, BeginsWhereThePlayheadIs) {
    Playhead playhead(folder_ / "a.pcap");
    while (playhead.step(5.0) != Playhead::Step::nothing_due) {
    }
    BoneReplica mirror(playhead.bone());
    EXPECT_EQ(mirror.checksum(), checksum_at(5.0));
    RecordedSession session(playhead, 1.0, clock());
    session.update(mirror, 1);
    pass(1.0);
    EXPECT_NEAR(session.update(mirror, 1).tool.time_s, 6.0, 1e-6);
    mirror.take_changes();
    EXPECT_EQ(mirror.checksum(), checksum_at(6.0));
}

TEST_F(RecordedSessionTest, EndsWithItsSessionOrWithWhatCannotBeRead) {
    testing::join(folder_ / "a.pcap", folder_ / "a.pcap", folder_ / "twice.pcap");
    Playhead twice(folder_ / "twice.pcap");
    BoneReplica mirror(twice.bone());
    RecordedSession first(twice, 1.0, clock());
    first.update(mirror, 1);
    pass(1000.0);
    first.update(mirror, 1);
    EXPECT_TRUE(first.is_over());
    mirror.take_changes();
    EXPECT_EQ(mirror.checksum(), checksum(made_.after));

    testing::spoil(folder_ / "a.pcap", 20);
    Playhead bad(folder_ / "a.pcap");
    BoneReplica other(bad.bone());
    RecordedSession second(bad, 1.0, clock());
    second.update(other, 1);
    pass(1000.0);
    second.update(other, 1);
    EXPECT_TRUE(second.is_over());
    EXPECT_NE(second.error().find("a.pcap, packet "), std::string::npos) << second.error();
}

TEST_F(RecordedSessionTest, TellsTheDistancesThatWereRecorded) {
    testing::make_recording(folder_ / "b.pcap", {.distances = [](int i) {
                                return std::vector{StructureDistance{.tissue = 0, .distance_mm = 0.01 * i}};
                            }});
    Playhead playhead(folder_ / "b.pcap");
    BoneReplica mirror(playhead.bone());
    RecordedSession session(playhead, 1.0, clock());
    session.update(mirror, 1);
    pass(4.0);
    const SessionState state = session.update(mirror, 1);
    ASSERT_EQ(state.distances.size(), 1u);
    EXPECT_NEAR(*state.distances[0].distance_mm, 0.8, 1e-9);
}

}  // namespace
}  // namespace osteomill
