#include "haptic_server/streaming/session_recorder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>
#include <vector>

#include "common/recording/playhead.h"
#include "common/wire/scene_messages.h"
#include "tests/support/eventually.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::eventually;

class SessionRecorderTest : public ::testing::Test {
  protected:
    void carve_and_record(int states) {
        testing::ReplicaSink to_mirror(mirror_);
        for (int i = 0; i < states; ++i) {
            for (int run = 0; run < 10; ++run) testing::carve_somewhere(bone_, random_, to_mirror);
            recorder_->note(mirror_.take_changes());
            tool_.time_s += 0.05;
            recorder_->record({.tool = tool_}, false);
        }
    }
    std::uintmax_t size() const { return std::filesystem::file_size(part_); }

    const testing::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "a.pcap";
    const std::filesystem::path part_ = folder_ / "a.part.pcap";  // until it is whole
    std::mt19937 random_{4};
    Bone bone_ = testing::make_speckled_bone(random_, {.grid = {.size_voxels = {64, 48, 32}}});
    BoneReplica mirror_{bone_};
    ToolState tool_;
    SampleQueue<TickSample> ticks_{300};
    std::optional<SessionRecorder> recorder_{
        std::in_place, RecordTo{.file = file_, .began = Stamp{std::chrono::hours(24)}, .ticks = &ticks_},
        to_message(testing::recorded_session_info()), mirror_};
};

TEST_F(SessionRecorderTest, GoesOnWithTheWholeBoneAfterTheDiskWasFull) {
    carve_and_record(20);
    ASSERT_TRUE(eventually([&] { return recorder_->report().frames >= 20; }));
    {
        const testing::FileSizeLimit disk(size() + 3'000);
        carve_and_record(200);
        ASSERT_TRUE(eventually([&] { return !recorder_->report().error.empty(); }));
        EXPECT_FALSE(Playhead(part_).is_truncated());
    }
    ASSERT_TRUE(eventually([&] { return recorder_->report().pauses == 1; }));
    carve_and_record(20);
    recorder_->finish({.tool = tool_}, "the end");
    EXPECT_EQ(recorder_->report().error, "");

    Playhead playhead(file_);
    bool has_goodbye = false;
    for (auto step = Playhead::Step::state; step != Playhead::Step::end;) {
        step = playhead.step(std::numeric_limits<double>::infinity());
        has_goodbye = has_goodbye || step == Playhead::Step::goodbye;
    }
    EXPECT_TRUE(has_goodbye);
    EXPECT_EQ(playhead.bone_checksum(), checksum(bone_));
}

TEST_F(SessionRecorderTest, TellsThatItStandsStillAndThatItGoesOnButRecordsNothingOfIt) {
    recorder_.reset();
    std::mutex mutex;
    std::vector<RecordingNews> news;
    const auto heard = [&] {
        const std::lock_guard lock(mutex);
        return news;
    };
    recorder_.emplace(RecordTo{.file = file_,
                               .began = Stamp{std::chrono::hours(24)},
                               .on_news =
                                   [&](RecordingNews one, const std::string& line) {
                                       EXPECT_THAT(line, ::testing::HasSubstr(part_.string()));
                                       const std::lock_guard lock(mutex);
                                       news.push_back(one);
                                   }},
                      to_message(testing::recorded_session_info()), mirror_);
    {
        const testing::FileSizeLimit disk(size() + 3'000);
        carve_and_record(200);
        ASSERT_TRUE(eventually([&] { return heard() == std::vector{RecordingNews::stands_still}; }));
        tool_.time_s += 0.05;
        recorder_->record({.tool = tool_, .status = {.undo_steps = 7, .recording_problem = "full"}}, false);
    }
    ASSERT_TRUE(eventually([&] { return heard().size() == 2; }));
    EXPECT_EQ(heard().back(), RecordingNews::goes_on);
    recorder_->finish({.tool = tool_, .status = {.undo_steps = 7, .recording_problem = "full"}}, "the end");
    Playhead playhead(file_);
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end)
        EXPECT_EQ(playhead.state().status.recording_problem, "");
    EXPECT_EQ(playhead.state().status.undo_steps, 7U) << "the last state is there";
}

TEST_F(SessionRecorderTest, HasNoTwoStatesOfOneTimeAndACheckSumInEach) {
    carve_and_record(3);
    recorder_->record({.tool = tool_}, false);  // says nothing more
    recorder_->record({.tool = tool_, .status = {.undo_steps = 1}}, false);
    recorder_->finish({.tool = tool_, .status = {.undo_steps = 1}}, "the end");
    Playhead playhead(file_);
    std::vector<double> times_s;
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
        if (times_s.size() == playhead.counts().states) continue;
        times_s.push_back(playhead.time_s());
        EXPECT_NEAR(static_cast<double>(playhead.tool()->taken_unix_ns) * 1e-9,
                    86'400.0 + playhead.tool()->time_s, 1e-5);
    }
    ASSERT_EQ(times_s.size(), 4U);
    EXPECT_EQ(playhead.counts().checksums_verified, 4U);
    EXPECT_TRUE(std::ranges::is_sorted(times_s, std::less_equal<>())) << "strictly";
    EXPECT_LT(times_s[3], times_s[2] + 0.001);
}

TEST_F(SessionRecorderTest, TellsTheTimeOfASessionThatBeganLaterAndPlaysWithoutTheWait) {
    recorder_->session_began(Stamp{std::chrono::hours(25)});
    carve_and_record(2);
    recorder_->finish({.tool = tool_}, "the end");
    Playhead playhead(file_);
    int states = 0;
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
        if (!playhead.tool()) continue;
        ++states;
        EXPECT_NEAR(static_cast<double>(playhead.tool()->taken_unix_ns) * 1e-9,
                    90'000.0 + playhead.tool()->time_s, 1e-5);
        EXPECT_NEAR(playhead.time_s(), playhead.tool()->time_s, 0.001);
    }
    EXPECT_GE(states, 2);
}

TEST_F(SessionRecorderTest, SaysThatTheEndIsMissingWhereTheDiskStaysFull) {
    const testing::FileSizeLimit disk(size() + 3'000);
    carve_and_record(200);
    recorder_->finish({.tool = tool_}, "the end");
    EXPECT_THAT(recorder_->report().error, ::testing::HasSubstr("File too large"));
    EXPECT_EQ(recorder_->report().pauses, 0U);
    EXPECT_EQ(recorder_->report().file, part_);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(SessionRecorderTest, HoldsEveryTickAndCountsThoseThatWereDropped) {
    int pushed = 0;
    const auto push = [&](int count) {
        for (int i = 0; i < count; ++i) ticks_.push({.time_s = 0.001 * pushed++});
    };
    push(310);  // 10 too many, which belong behind the first 300
    carve_and_record(1);
    push(20);
    carve_and_record(1);
    push(301);
    recorder_->finish({.tool = tool_}, "the end");
    EXPECT_EQ(recorder_->report().missed_ticks, 11U);

    Playhead playhead(file_);
    std::vector<int> ticks;
    std::vector<std::pair<std::uint64_t, std::size_t>> missed_behind;
    for (std::uint64_t missed = 0;;) {
        const auto step = playhead.step(std::numeric_limits<double>::infinity());
        if (step == Playhead::Step::end) break;
        if (step != Playhead::Step::state) continue;
        if (playhead.counts().missed_ticks > missed)
            missed_behind.emplace_back(playhead.counts().missed_ticks - missed, ticks.size());
        missed = playhead.counts().missed_ticks;
        for (const TickSample& tick : playhead.ticks())
            ticks.push_back(static_cast<int>(std::lround(1000.0 * tick.time_s)));
    }
    std::vector<int> expected;
    for (int i = 0; i < 630; ++i)
        if (i < 300 || i >= 310) expected.push_back(i);
    EXPECT_EQ(ticks, expected);
    using Missed = std::pair<std::uint64_t, std::size_t>;
    EXPECT_THAT(missed_behind, ::testing::ElementsAre(Missed(10, 300), Missed(1, 620)));
    EXPECT_TRUE(playhead.session().holds_ticks);
}

}  // namespace
}  // namespace osteomill
