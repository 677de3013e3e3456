#include "haptic_server/streaming/outgoing_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/support/block.h"
#include "tests/support/random_carving.h"
#include "tests/support/replica.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

/// Carves the mirror and passes the changes to a OutgoingFrames, as the server does at every frame.
class Carver final : public ChangeSink {
  public:
    Carver(BoneReplica& mirror, OutgoingFrames& outgoing)
        : bone_(mirror.bone()), mirror_(mirror), outgoing_(outgoing) {}
    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        ASSERT_TRUE(mirror_.apply(change, fractions));
    }
    void carve(int runs) {
        for (int i = 0; i < runs; ++i) testing::carve_somewhere(bone_, random_, *this);
        outgoing_.note(mirror_.take_changes());
    }

    /// Gives the bricks that differ from `earlier` the fractions that they had then, as undo does.
    void restore(const Bone& earlier) {
        for (std::size_t slot = 0; slot < bone_.stored_bricks(); ++slot) {
            const auto before = earlier.fractions(static_cast<std::int32_t>(slot));
            const auto now = bone_.fractions(static_cast<std::int32_t>(slot));
            VoxelMask differing;
            for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
                if (before[voxel] != now[voxel]) differing.set(voxel);
            if (differing.none()) continue;
            std::ranges::copy(before, now.begin());
            push({bone_.content().brick_of_slot[slot], differing, ChangeKind::restored}, before);
        }
        outgoing_.note(mirror_.take_changes());
    }

    /// Carves only the lower half of the bricks, voxel by voxel.
    void carve_first_bricks(int voxels) {
        for (int i = 0; i < voxels; ++i) {
            const std::size_t slot = random_() % (bone_.stored_bricks() / 2);
            push({bone_.content().brick_of_slot[slot], VoxelMask().set(random_() % brick_voxel_count)},
                 ByteBrick{});
        }
        outgoing_.note(mirror_.take_changes());
    }

  private:
    Bone bone_;
    BoneReplica& mirror_;
    OutgoingFrames& outgoing_;
    std::mt19937 random_{5};

  public:
    const Bone& bone() const { return bone_; }
};

class OutgoingFramesTest : public ::testing::Test {
  protected:
    OutgoingFramesTest() {
        std::mt19937 random(2);
        mirror_.emplace(testing::make_speckled_bone(random, {.grid = {.size_voxels = {128, 128, 64}}}));
        v2::Hello hello;
        hello.add_burrs()->set_diameter_mm(2.0);
        outgoing_.emplace(hello, *mirror_, packers_);
        carver_.emplace(*mirror_, *outgoing_);
    }
    /// Lets the client take all there is; says how many frames that were.
    int drain() {
        int frames = 0;
        while (auto frame = outgoing_->next()) {
            replica_.take(*frame);
            ++frames;
        }
        return frames;
    }
    void expect_equal() { EXPECT_EQ(checksum(*replica_.bone()), mirror_->checksum()); }

    FramePackers packers_;
    std::optional<BoneReplica> mirror_;
    std::optional<OutgoingFrames> outgoing_;
    std::optional<Carver> carver_;
    testing::Replica replica_;
};

TEST_F(OutgoingFramesTest, BringsAClientThatJoinsWhileCarvingGoesOnLevelWithTheMirror) {
    int frames = 0;
    while (auto frame = outgoing_->next()) {
        replica_.take(*frame);
        carver_->carve(200);  // between any two frames of the snapshot
        ++frames;
    }
    EXPECT_GT(frames, 10);
    outgoing_->request_state({}, true);
    drain();
    EXPECT_EQ(replica_.checksums(), 1U);
    expect_equal();
}

TEST_F(OutgoingFramesTest, TellsASlowClientLaterWhatItMissed) {
    drain();
    for (int i = 0; i < 100; ++i) {
        carver_->carve(10);
        outgoing_->request_state({.tool = {.time_s = 0.1 * i}}, i == 50);
    }
    EXPECT_LE(drain(), 2) << "frames that could not be sent are skipped";
    EXPECT_EQ(replica_.checksums(), 1U) << "a checksum once requested is stated";
    expect_equal();
}

TEST_F(OutgoingFramesTest, SplitsChangesThatDoNotFitAFrame) {
    drain();
    carver_->carve(60'000);
    outgoing_->request_state({}, true);
    EXPECT_GT(drain(), 2);
    EXPECT_EQ(replica_.checksums(), 1U) << "only the last part states a checksum";
    expect_equal();
}

TEST_F(OutgoingFramesTest, SaysLittleAtATimeOverASlowLink) {
    drain();
    carver_->carve(5'000);
    outgoing_->request_state({}, true);
    int frames = 0;
    while (auto frame = outgoing_->next(FramePace::least)) {
        // A single brick may be more, but not by much.
        EXPECT_LT(frame->size(), FramePace::least + brick_voxel_count + brick_voxel_count / 4);
        replica_.take(*frame);
        ++frames;
    }
    EXPECT_GT(frames, 10);
    expect_equal();
}

TEST_F(OutgoingFramesTest, TellsChangesInOneFrameOrMany) {
    drain();
    for (int i = 0; i < 30; ++i) {
        carver_->carve(i < 10 ? 20 : 5'000);  // some in more than a frame
        outgoing_->request_state({.tool = {.time_s = 0.1 * i, .burr_position_mm = glm::dvec3(0.2 * i)}},
                                 i % 10 == 9);
        drain();
    }
    EXPECT_EQ(replica_.checksums(), 3U);
    expect_equal();
}

TEST_F(OutgoingFramesTest, TellsOfEveryBrickInTurnHoweverFastTheFirstOnesChange) {
    drain();
    const BrickIndex last = mirror_->bone().content().brick_of_slot.back();
    carver_->carve(60'000);
    outgoing_->request_state({}, false);
    int frames = 0;
    for (bool is_told = false; !is_told; ++frames) {
        ASSERT_LT(frames, 20);
        replica_.take(*outgoing_->next());
        const auto slot = mirror_->bone().slot(last);
        is_told = std::ranges::equal(replica_.bone()->fractions(slot), mirror_->bone().fractions(slot));
        carver_->carve_first_bricks(20'000);  // more than a frame's worth
        outgoing_->request_state({}, false);
    }
    EXPECT_GT(frames, 1);
}

TEST_F(OutgoingFramesTest, CostsNoMoreForAClientThatNeverReadsThanForItsDirtyBricks) {
    drain();
    for (int i = 0; i < 300; ++i) {
        carver_->carve(300);
        outgoing_->request_state({.tool = {.time_s = 0.1 * i}}, i % 30 == 0);
    }
    EXPECT_LE(outgoing_->pending().bricks(), mirror_->bone().stored_bricks());
    EXPECT_LE(outgoing_->pending().masks(), PendingChanges::most_masks);
    EXPECT_LT(drain(), 300) << "frames";
    expect_equal();
}

/// All bricks of the bone as one part, with a checksum that is not theirs.
v2::CompareBone doubt_of(const Bone& bone) {
    v2::CompareBone request;
    v2::BrickRange& range = *request.add_ranges();
    const glm::uvec3 size(bone.content().size_bricks);
    range.set_brick_count(std::uint64_t{size.x} * size.y * size.z);
    range.set_bricks_per_part(range.brick_count());
    range.add_part_checksum(checksum(bone) + 1);
    return request;
}

TEST_F(OutgoingFramesTest, TellsBricksThatDifferWhole) {
    drain();
    const BrickIndex brick = mirror_->bone().content().brick_of_slot[7];
    v2::CompareBone request;
    v2::BrickRange& range = *request.add_ranges();
    range.set_first_brick(brick);
    range.set_brick_count(1);
    range.set_bricks_per_part(1);
    range.add_part_checksum(checksum_of_brick(brick, mirror_->bone().fractions(7)));
    EXPECT_FALSE(outgoing_->compare(request));
    EXPECT_EQ(drain(), 1);
    EXPECT_EQ(replica_.bricks_of_last_state(), 0U) << "it does not differ";
    EXPECT_EQ(replica_.checksums(), 1U);
    range.set_part_checksum(0, 5);
    EXPECT_FALSE(outgoing_->compare(request));
    drain();
    EXPECT_EQ(replica_.bricks_of_last_state(), 1U);
    EXPECT_EQ(replica_.checksums(), 2U);
    EXPECT_TRUE(outgoing_->pending().empty());
}

TEST_F(OutgoingFramesTest, RefusesComparisonsThatNoHonestClientAsksFor) {
    const v2::CompareBone request = doubt_of(mirror_->bone());
    EXPECT_EQ(outgoing_->compare(request)->line, "it compares a bone that it has not been sent yet");
    drain();
    EXPECT_EQ(outgoing_->compare({})->line, "comparison refused: it has 0 parts, not 1 to 128");
    EXPECT_FALSE(outgoing_->compare(request));
    EXPECT_EQ(outgoing_->compare(request)->line, "it compares again before it has been answered");
    drain();
    for (int i = 0; i < 2 * most_requests_of_a_search - 2; ++i) {
        ASSERT_FALSE(outgoing_->compare(request));
        drain();
    }
    EXPECT_EQ(outgoing_->compare(request)->line, "it compares too often");
    outgoing_->request_state({}, false);
    EXPECT_FALSE(outgoing_->compare(request)) << "one for each state";
}

TEST_F(OutgoingFramesTest, SaysNothingBetweenStates) {
    drain();
    carver_->carve(10);
    EXPECT_FALSE(outgoing_->next());
    outgoing_->request_state({}, false);
    EXPECT_EQ(drain(), 1);
    EXPECT_EQ(replica_.checksums(), 0U);
    outgoing_->request_state({.tool = {.spindle_on = true}}, false);
    drain();
    EXPECT_EQ(replica_.bricks_of_last_state(), 0U) << "told once";
}

TEST_F(OutgoingFramesTest, TellsOfAToolThatRestsTenTimesASecond) {
    drain();
    int frames = 0;
    for (int i = 0; i < 90; ++i) {
        outgoing_->request_state({.tool = {.time_s = i / 30.0}}, i % 30 == 0);
        frames += drain();
    }
    EXPECT_EQ(frames, 30);
    EXPECT_EQ(replica_.checksums(), 3U);
    outgoing_->request_state({.tool = {.time_s = 3.0}}, false);
    EXPECT_EQ(drain(), 1);
    outgoing_->request_state({.tool = {.time_s = 3.001, .force_n = {1, 0, 0}}}, false);
    EXPECT_EQ(drain(), 1) << "news goes out at once";
    carver_->carve(1);
    outgoing_->request_state({.tool = {.time_s = 3.002, .force_n = {1, 0, 0}}}, false);
    EXPECT_EQ(drain(), 1);
}

TEST_F(OutgoingFramesTest, EndsWithTheFinalChecksumAndGoodbyeEvenInTheMiddleOfASnapshot) {
    replica_.take(*outgoing_->next());
    replica_.take(*outgoing_->next());
    replica_.take(*outgoing_->next());
    carver_->carve(1000);
    outgoing_->finish("the end");
    EXPECT_FALSE(outgoing_->is_finished());
    drain();
    EXPECT_TRUE(outgoing_->is_finished());
    EXPECT_TRUE(replica_.has_goodbye());
    EXPECT_EQ(replica_.checksums(), 1U);
    expect_equal();
}

TEST(OutgoingFrames, ServesABoneWithoutBricks) {
    const BoneReplica mirror(BoneBuilder::homogeneous({.size_voxels = {20, 20, 20}}, 1.0, false).build());
    FramePackers packers;
    OutgoingFrames outgoing({}, mirror, packers);
    outgoing.request_state({}, true);
    outgoing.finish("the end");
    testing::Replica replica;
    while (auto frame = outgoing.next()) replica.take(*frame);
    EXPECT_TRUE(replica.has_goodbye());
    EXPECT_EQ(replica.bone()->stored_bricks(), 0U);
}

TEST_F(OutgoingFramesTest, GivesBoneBackToAClientHoweverFewOfTheFramesItGets) {
    std::mt19937 random(8);
    drain();
    for (int i = 0; i < 80; ++i) {
        const Bone before = carver_->bone();
        carver_->carve(200);
        if (random() % 2 == 0) outgoing_->request_state({.tool = {.time_s = 0.1 * i}}, false);
        if (random() % 2 == 0) drain();
        carver_->restore(before);
        if (random() % 2 == 0) carver_->carve(50);
        outgoing_->request_state({.tool = {.time_s = 0.1 * i}}, true);
        if (random() % 2 == 0) drain();
    }
    drain();
    expect_equal();
    EXPECT_GT(replica_.restored_bricks(), 100U);
    EXPECT_GT(replica_.checksums(), 10U);
}

TEST_F(OutgoingFramesTest, TellsEachEventOnceAndTheNewestStatus) {
    drain();
    const std::vector<ControlEvent> events(700,
                                           {.time_s = 1.0, .action = SessionAction::mark, .text = "here"});
    outgoing_->request_state({.events = events, .status = {.undo_steps = 2}}, false);
    EXPECT_GE(drain(), 1);
    EXPECT_EQ(replica_.events(), 700U);
    outgoing_->request_state({.status = {.undo_steps = 2}}, false);
    EXPECT_EQ(drain(), 0) << "nothing is new";
    outgoing_->request_state({.status = {.undo_steps = 3}}, false);
    EXPECT_EQ(drain(), 1) << "that is";
    EXPECT_EQ(replica_.events(), 700U);
}

TEST_F(OutgoingFramesTest, SendsTheCtBetweenStatesToWhoAsksAndOnce) {
    const auto ct = std::make_shared<CtVolume>(
        CtVolume{.grid = {.size_voxels = {64, 64, 40}}, .hu = std::vector<std::int16_t>(64 * 64 * 40, 7)});
    drain();
    EXPECT_FALSE(outgoing_->wants_ct());
    outgoing_->ask_for_ct();
    EXPECT_TRUE(outgoing_->wants_ct());
    outgoing_->give_ct(ct);
    EXPECT_FALSE(outgoing_->wants_ct());
    CtAssembler assembler;
    std::shared_ptr<const CtVolume> arrived;
    int states = 0;
    FrameDecoder decoder;
    for (int i = 0; i < 20; ++i) {
        if (i % 2 == 0) outgoing_->request_state({.tool = {.time_s = 1.0 * i}}, true);
        const auto bytes = outgoing_->next();
        if (!bytes) break;
        decoder.append({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
        const auto message = decoder.next();
        v2::ServerFrame frame;
        ASSERT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
        states += frame.has_state();
        if (frame.has_ct_piece()) arrived = std::get<0>(assembler.take(frame.ct_piece()));
    }
    ASSERT_TRUE(arrived);
    EXPECT_EQ(arrived->hu, ct->hu);
    EXPECT_GE(states, 5) << "states come first";
    outgoing_->ask_for_ct();
    EXPECT_FALSE(outgoing_->wants_ct());
}

const ToolState told{.time_s = 5.0,
                     .burr_position_mm = {1, 2, 3},
                     .hand_position_mm = {1, 2, 4},
                     .force_n = {0, 0, 1},
                     .burr = 1};

TEST(QuietTool, MayTrembleAndAge) {
    ToolState now = told;
    now.time_s += 0.09;
    now.taken_unix_ns += 90'000'000;
    now.burr_position_mm.x += 0.001;
    now.force_n.y -= 0.001;
    EXPECT_TRUE(is_within_deadband(told, now));
    now.time_s = 5.1;
    EXPECT_FALSE(is_within_deadband(told, now)) << "now and then it is told of, anyway";
    now.time_s = 4.9;
    EXPECT_FALSE(is_within_deadband(told, now)) << "time went back: another session or place in a recording";
}

TEST(QuietTool, DoesNothingThatAViewerWouldSee) {
    const std::vector<std::function<void(ToolState&)>> changes{
        [](ToolState& tool) { tool.burr_position_mm.z += 0.01; },
        [](ToolState& tool) { tool.hand_position_mm.x += 0.01; },
        [](ToolState& tool) {
            tool.spindle_axis = {0.001, 0, 1};
        },
        [](ToolState& tool) { tool.force_n.x = 0.01; },
        [](ToolState& tool) { tool.burr = 0; },
        [](ToolState& tool) { tool.spindle_on = true; },
        [](ToolState& tool) { tool.removed_mm3 = 1e-9; },
        [](ToolState& tool) { tool.touches_protected = true; },
        [](ToolState& tool) { tool.fixtures_on = 1; },
        [](ToolState& tool) { tool.fixtures_acting = 1; },
        [](ToolState& tool) { tool.fault = "the device is gone"; }};
    for (const auto& change : changes) {
        ToolState now = told;
        change(now);
        EXPECT_FALSE(looks_the_same(told, now)) << "change " << &change - changes.data();
    }
}

}  // namespace
}  // namespace osteomill
