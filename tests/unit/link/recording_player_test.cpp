#include "render_client/link/recording_player.h"

#include <gmock/gmock.h>

#include "tests/support/ball_structure.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::MadeRecording;

/// A viewer that copies only reported changes, as textures do.
class Viewer {
  public:
    explicit Viewer(RecordingPlayer& player) : player_(player) {}

    /// Lets time pass, and reads the changes of that time.
    const LinkUpdate& look(double elapsed_s = 0.0) {
        now_ += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(elapsed_s));
        last_ = player_.poll(now_);
        if (last_.bone_replaced) shown_.emplace(*player_.bone());
        for (const auto& [brick, voxels, kind] : last_.changes) {
            const std::int32_t slot = shown_->slot(brick);
            for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
                if (voxels[voxel]) shown_->fractions(slot)[voxel] = player_.bone()->fractions(slot)[voxel];
        }
        if (last_.tool) tool_ = last_.tool;
        return last_;
    }
    /// Polls until a seek has arrived.
    void arrive() {
        for (int i = 0; i < 100; ++i) look();
    }
    std::uint64_t shown_checksum() const { return checksum(*shown_); }
    const std::optional<ToolState>& tool() const { return tool_; }
    const LinkUpdate& last() const { return last_; }

  private:
    RecordingPlayer& player_;
    RecordingPlayer::Time now_{};
    LinkUpdate last_;
    std::optional<Bone> shown_;
    std::optional<ToolState> tool_;
};

class RecordingPlayerTest : public ::testing::Test {
  protected:
    RecordingPlayerTest() : made_(testing::make_recording(folder_ / "a.pcap", {.states = 600})) {}

    std::uint64_t checksum_at(double time_s) const {
        return made_.checksum_after_state[static_cast<std::size_t>(time_s / MadeRecording::period_s + 0.01)];
    }

    testing::TemporaryFolder folder_;
    MadeRecording made_;
};

TEST_F(RecordingPlayerTest, PlaysToTheEndAndThenFromTheBeginning) {
    RecordingPlayer player(folder_ / "a.pcap");
    Viewer viewer(player);
    EXPECT_NEAR(player.duration_s(), made_.duration_s(), 1e-6);
    EXPECT_TRUE(viewer.look().bone_replaced);
    EXPECT_EQ(viewer.shown_checksum(), checksum(made_.before)) << "first as it first was";
    EXPECT_FALSE(viewer.look(2.0).bone_replaced);
    EXPECT_EQ(viewer.last().status, LinkStatus::live);
    EXPECT_NEAR(viewer.tool()->time_s, 2.0, 1e-6);
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(2.0));

    viewer.look(100.0);
    EXPECT_EQ(viewer.last().status, LinkStatus::finished);
    EXPECT_FALSE(player.is_playing());
    EXPECT_EQ(viewer.shown_checksum(), checksum(made_.after));
    EXPECT_GT(viewer.last().checksums_verified, 25U);

    player.play();
    viewer.look();
    EXPECT_TRUE(player.is_playing());
    EXPECT_EQ(viewer.last().status, LinkStatus::live);
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(0.0));
}

TEST_F(RecordingPlayerTest, GoesToAnyTimeInBothDirections) {
    RecordingPlayer player(folder_ / "a.pcap");
    player.pause();
    Viewer viewer(player);
    viewer.look();
    std::mt19937 random(12);
    std::uniform_real_distribution<double> anywhere(0.0, made_.duration_s());
    for (int i = 0; i < 60; ++i) {
        const double time_s = anywhere(random);
        player.seek(time_s);
        viewer.arrive();
        ASSERT_EQ(checksum(*player.bone()), checksum_at(time_s)) << time_s;
        ASSERT_EQ(viewer.shown_checksum(), checksum_at(time_s)) << "some voxel was not said to have changed";
        ASSERT_NEAR(viewer.tool()->time_s, time_s, MadeRecording::period_s + 1e-6);
    }
    EXPECT_EQ(player.error(), "") << "every checksum on the way held";
    player.seek(-5.0);
    viewer.arrive();
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(0.0));
    player.seek(1e9);
    viewer.arrive();
    EXPECT_EQ(viewer.shown_checksum(), checksum(made_.after));
}

TEST_F(RecordingPlayerTest, PausesAndChangesItsSpeed) {
    RecordingPlayer player(folder_ / "a.pcap", 4.0);
    Viewer viewer(player);
    viewer.look();
    viewer.look(1.0);
    EXPECT_NEAR(player.time_s(), 4.0, 1e-6);
    player.pause();
    viewer.look(5.0);
    EXPECT_NEAR(player.time_s(), 4.0, 1e-6);
    player.play();
    player.set_speed(0.5);
    viewer.look(1.0);
    EXPECT_NEAR(player.time_s(), 4.5, 1e-6);
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(4.5));
}

TEST_F(RecordingPlayerTest, WaitsForAWindowThatCannotShowItYet) {
    RecordingPlayer player(folder_ / "a.pcap");
    Viewer viewer(player);
    viewer.look();
    player.wait();
    viewer.look(1.0);
    EXPECT_NEAR(player.time_s(), 0.0, 1e-6);
    viewer.look(1.0);
    EXPECT_NEAR(player.time_s(), 1.0, 1e-6);
}

TEST_F(RecordingPlayerTest, GoesBackIntoTheSessionBeforeInAJoinedRecording) {
    const MadeRecording second = testing::make_recording(folder_ / "b.pcap", {.states = 100, .seed = 9});
    testing::join(folder_ / "a.pcap", folder_ / "b.pcap", folder_ / "both.pcap");
    RecordingPlayer player(folder_ / "both.pcap");
    player.pause();
    Viewer viewer(player);
    viewer.look();
    player.seek(made_.duration_s() + 2.0);
    viewer.arrive();
    EXPECT_EQ(viewer.shown_checksum(), second.checksum_after_state[40]);
    player.seek(7.0);
    viewer.arrive();
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(7.0));
}

TEST_F(RecordingPlayerTest, KnowsWhenASeekHasArrived) {
    RecordingPlayer player(folder_ / "a.pcap");
    player.pause();
    EXPECT_FALSE(player.has_arrived()) << "nothing has been shown yet";
    Viewer viewer(player);
    for (const double time_s : {0.0, 29.0, 3.0, player.duration_s()}) {
        player.seek(time_s);
        int polls = 0;
        do viewer.look();
        while (!player.has_arrived() && ++polls < 100);
        EXPECT_LT(polls, 100) << time_s;
        EXPECT_EQ(viewer.shown_checksum(), checksum_at(time_s)) << time_s;
    }
}

TEST_F(RecordingPlayerTest, EndsWhereItCannotBeReadFurtherAndSaysWhy) {
    testing::spoil(folder_ / "a.pcap", 50);
    RecordingPlayer player(folder_ / "a.pcap");
    Viewer viewer(player);
    viewer.look();
    viewer.look(1000.0);
    EXPECT_EQ(viewer.last().status, LinkStatus::refused);
    EXPECT_THAT(player.error(), ::testing::HasSubstr("a.pcap, packet "));
    EXPECT_EQ(viewer.last().status_line, player.error());
    player.seek(3.0);
    viewer.arrive();
    EXPECT_EQ(viewer.last().status, LinkStatus::live) << "what was before is still there";
    EXPECT_EQ(viewer.shown_checksum(), checksum_at(3.0));
    EXPECT_THROW(RecordingPlayer("/nowhere/a.pcap"), RecordingError);
}

TEST_F(RecordingPlayerTest, KeepsKeyFramesNoLargerThanWhatWasMilled) {
    RecordingPlayer player(folder_ / "a.pcap");
    Viewer viewer(player);
    viewer.look();
    EXPECT_LT(player.key_frame_bytes(), 1000U);
    viewer.look(100.0);
    // 7 of them, of at most all bricks; these hold random numbers, which do not compress.
    EXPECT_GT(player.key_frame_bytes(), 1000U);
    EXPECT_LT(player.key_frame_bytes(), 7 * player.bone()->stored_bricks() * 4200);
}

TEST_F(RecordingPlayerTest, BringsProtectedStructuresWithTheBoneAndTheirDistancesAtAnyTime) {
    const Structure nerve{0, testing::ball_mask({.size_voxels = {64, 48, 32}}, {2.0, 2.0, 1.5}, 1.0)};
    testing::make_recording(folder_ / "b.pcap",
                            {.states = 400, .structures = {nerve}, .distances = [](int i) {
                                 StructureDistance at{.tissue = 0, .distance_mm = 0.01 * i};
                                 if (i > 300) at.distance_mm.reset();
                                 return std::vector{at};
                             }});
    RecordingPlayer player(folder_ / "b.pcap");
    Viewer viewer(player);
    const LinkUpdate& first = viewer.look();
    EXPECT_TRUE(first.bone_replaced);
    ASSERT_EQ(first.structures.size(), 1u);
    EXPECT_TRUE(first.structures[0].mask == nerve.mask);
    const auto distance_at = [&](double time_s) {
        player.seek(time_s);
        viewer.arrive();
        EXPECT_TRUE(viewer.last().structures.empty()) << "once is enough";
        return viewer.last().distances.at(0).distance_mm;
    };
    player.pause();
    EXPECT_NEAR(*distance_at(10.0), 2.0, 1e-9);
    EXPECT_FALSE(distance_at(17.0));
    EXPECT_NEAR(*distance_at(3.0), 0.6, 1e-9) << "wound back";
    EXPECT_NEAR(*distance_at(0.0), 0.0, 1e-9) << "to the beginning";
}

}  // namespace
}  // namespace osteomill
