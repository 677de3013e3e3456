#include "haptic_server/streaming/control_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/support/random_carving.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

/// Controls with the milling loop's bone on one side and the copy that clients are shown on the other.
class SessionControlsTest : public ::testing::Test, public ChangeSink {
  protected:
    SessionControlsTest()
        : milled_(testing::make_speckled_bone(random_)),
          mirror_(milled_),
          restored_(1 << 16, milled_.shared_content()),
          changes_(1 << 20, milled_.shared_content()),
          controls_(gate_, restored_, placements_,
                    {.save =
                         [this](const Bone& bone, const std::string&) {
                             saved_ = checksum(bone);
                             return std::string(can_save_ ? "" : "the disk is full");
                         },
                     .finish =
                         [this] {
                             is_finished_ = true;
                             return std::string();
                         },
                     .save_news = [this] { return std::exchange(save_news_, {}); },
                     .place = [](const Bone&, const ToolPose& wanted,
                                 std::size_t) -> std::variant<ToolPose, std::string> {
                         if (wanted.position_mm.x > 100.0) return std::string("too far");
                         return ToolPose{wanted.position_mm + wanted.spindle_axis, wanted.spindle_axis};
                     },
                     .lift_out = [this](const Bone&, const ToolPose&, std::size_t) { return lifted_; },
                     .placed = [this](const ToolPose& pose) { placed_ = pose; },
                     .fixtures = {"Shaft", "", "Off the nerve"}}) {}

    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        changes_.push(change, fractions);
    }
    void mill() {
        for (int i = 0; i < 50; ++i) testing::carve_somewhere(milled_, random_, *this);
    }
    /// Consumes a part of the queue, as a step of the milling loop does.
    void milling_steps(std::size_t bricks) {
        gate_.restored_changes += restored_.consume_all(
            [&](const BrickChange& change, BrickFractions fractions) {
                ASSERT_TRUE(apply(change, fractions, milled_));
                changes_.push(change, fractions);
            },
            bricks);
    }
    void frame(bool spindle_on = false) {
        controls_.begin_frame();
        changes_.consume_all([&](const BrickChange& change, BrickFractions fractions) {
            controls_.note(change, mirror_);
            ASSERT_TRUE(apply(change, fractions, mirror_));
        });
        controls_.end_frame(mirror_, {.time_s = time_s_ += 0.03, .spindle_on = spindle_on});
    }
    /// Takes one level of one voxel, which nobody sees.
    void touch_lightly() {
        for (std::int32_t slot = 0;; ++slot) {
            const auto fractions = milled_.fractions(slot);
            const auto voxel = std::ranges::find_if(fractions, [](std::uint8_t left) { return left > 0; });
            if (voxel == fractions.end()) continue;
            --*voxel;
            push({milled_.content().brick_of_slot[static_cast<std::size_t>(slot)],
                  VoxelMask().set_run(static_cast<std::size_t>(voxel - fractions.begin()), 1)},
                 fractions);
            return;
        }
    }
    void stroke() {
        mill();
        frame(true);
        frame();
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) {
            milling_steps(3);
            frame();
        }
    }
    bool holds_still() const { return gate_.stillness.is_wanted(); }

    std::mt19937 random_{3};
    Bone milled_;
    Bone mirror_;
    SessionGate gate_;
    ChangeQueue restored_;
    ChangeQueue changes_;
    TripleBuffer<Placement> placements_;
    std::optional<ToolPose> placed_;
    std::optional<ToolPose> lifted_;
    ControlRunner controls_;
    double time_s_ = 0.0;
    bool can_save_ = true;
    bool is_finished_ = false;
    std::uint64_t saved_ = 0;
    std::vector<std::string> save_news_;
};

TEST_F(SessionControlsTest, UndoesAStrokeThroughTheMillingLoop) {
    const std::uint64_t whole = checksum(milled_);
    stroke();
    const std::uint64_t milled = checksum(milled_);
    ASSERT_NE(milled, whole);
    controls_.control({SessionAction::undo});
    frames(60);
    EXPECT_EQ(checksum(milled_), whole);
    EXPECT_EQ(checksum(mirror_), whole);
    EXPECT_FALSE(holds_still());
    EXPECT_EQ(controls_.status(), (SessionStatus{.undo_steps = 0, .redo_steps = 1}));
    controls_.control({SessionAction::redo});
    frames(60);
    EXPECT_EQ(checksum(milled_), milled);
    EXPECT_EQ(checksum(mirror_), milled);
}

TEST_F(SessionControlsTest, UndoesASliceThatNobodySeesWithTheOneBefore) {
    const std::uint64_t whole = checksum(milled_);
    stroke();
    for (int i = 0; i < 2; ++i) {
        touch_lightly();
        frame(true);
        frame();
    }
    ASSERT_EQ(controls_.status().undo_steps, 3U);
    controls_.control({SessionAction::undo});
    frames(60);
    EXPECT_EQ(checksum(milled_), whole);
    EXPECT_EQ(controls_.status(), (SessionStatus{.undo_steps = 0, .redo_steps = 3}));
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NE(events[0].text, "0.00 mm\u00b3");
    touch_lightly();
    frame(true);
    frame();
    controls_.control({SessionAction::undo});
    frames(60);
    EXPECT_EQ(checksum(milled_), whole) << "nothing was before it";
    EXPECT_EQ(controls_.take_events().at(0).text, "less than 0.01 mm\u00b3");
}

TEST_F(SessionControlsTest, MakesAPauseThatEndsInTheSameFrameOne) {
    frame();
    ASSERT_FALSE(gate_.stillness.was_wanted());
    controls_.control({SessionAction::pause});
    controls_.control({SessionAction::resume});
    frame();
    EXPECT_FALSE(holds_still());
    EXPECT_TRUE(gate_.stillness.was_wanted()) << "the haptic loop ends what it permitted";
}

TEST_F(SessionControlsTest, HoldsTheSessionStillUntilAllOfItIsBack) {
    stroke();
    controls_.control({SessionAction::undo});
    frame();
    EXPECT_TRUE(holds_still());
    int waited = 0;
    for (; holds_still() && waited < 100; ++waited) {
        EXPECT_TRUE(holds_still());
        milling_steps(1);
        frame();
    }
    EXPECT_GT(waited, 5);
    EXPECT_LT(waited, 100);
    EXPECT_EQ(checksum(milled_), checksum(mirror_));
}

TEST_F(SessionControlsTest, UndoesOnlyOnceTheStrokeHasEnded) {
    mill();
    frame(true);
    controls_.control({SessionAction::undo});
    frame(true);
    EXPECT_TRUE(holds_still()) << "which turns the spindle off";
    EXPECT_TRUE(controls_.take_events().empty());
    frames(60);
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].action, SessionAction::undo);
    EXPECT_FALSE(events[0].is_refused);
    EXPECT_EQ(controls_.status().undo_steps, 0U);
}

TEST_F(SessionControlsTest, CountsTheStrokeUnderWayAmongThoseThatCanBeUndone) {
    mill();
    frame(true);
    EXPECT_EQ(controls_.status().undo_steps, 1U);
}

TEST_F(SessionControlsTest, GivesALongStrokeBackInSlicesAndSaysHowMuch) {
    const double whole_mm3 = bone_volume_mm3(milled_);
    for (int i = 0; i < 250; ++i) {  // 7.5 s with a latched pedal
        testing::carve_somewhere(milled_, random_, *this);
        frame(true);
    }
    EXPECT_EQ(controls_.status().undo_steps, 3U) << "two have ended, one is under way";
    controls_.control({SessionAction::undo});
    frames(400);
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_TRUE(events[0].text.ends_with(" mm\u00b3")) << events[0].text;
    EXPECT_EQ(controls_.status(), (SessionStatus{.undo_steps = 2, .redo_steps = 1}));
    EXPECT_LT(bone_volume_mm3(mirror_), whole_mm3) << "the slices before stay";
    EXPECT_GT(std::stod(events[0].text), 0.0);
}

TEST_F(SessionControlsTest, EndsAStrokeInAirThoughThePedalStaysDown) {
    const std::uint64_t whole = checksum(milled_);
    mill();
    frame(true);
    const std::uint64_t after_first = checksum(milled_);
    for (int i = 0; i < 20; ++i) frame(true);
    mill();
    frame(true);
    EXPECT_EQ(controls_.status().undo_steps, 2U);
    controls_.control({SessionAction::undo});
    frames(60);
    EXPECT_EQ(checksum(mirror_), after_first);
    controls_.control({SessionAction::undo});
    frames(60);
    EXPECT_EQ(checksum(mirror_), whole);
}

TEST_F(SessionControlsTest, LiftsTheToolOutOfTheBoneThatCameBackBeforeTheSessionGoesOn) {
    stroke();
    lifted_ = ToolPose{{0.0, 0.0, 8.0}, {0.0, 0.0, 1.0}};
    controls_.control({SessionAction::undo});
    for (int i = 0; i < 20 && !placements_.refresh(); ++i) {
        EXPECT_EQ(gate_.placed, 0U);
        milling_steps(1000);
        frame();
    }
    EXPECT_EQ(placements_.front().number, 1U);
    EXPECT_EQ(checksum(milled_), checksum(mirror_));
    EXPECT_TRUE(holds_still());
    gate_.placed = 1;
    frame();
    EXPECT_FALSE(holds_still());
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].action, SessionAction::undo);
    EXPECT_EQ(events[1].action, SessionAction::place);
    EXPECT_FALSE(events[1].is_refused);
    EXPECT_FALSE(placed_) << "nobody asked for it";
}

TEST_F(SessionControlsTest, ResetsAllStrokesAndRedoesThemOneByOne) {
    std::vector<std::uint64_t> checksums{checksum(milled_)};
    for (int i = 0; i < 5; ++i) {
        stroke();
        checksums.push_back(checksum(milled_));
    }
    controls_.control({SessionAction::reset});
    frames(400);
    EXPECT_EQ(checksum(mirror_), checksums[0]);
    EXPECT_FALSE(holds_still());
    EXPECT_EQ(controls_.status(), (SessionStatus{.undo_steps = 0, .redo_steps = 5}));
    EXPECT_EQ(controls_.take_events().size(), 1U);
    for (int i = 1; i <= 5; ++i) {
        controls_.control({SessionAction::redo});
        frames(60);
        EXPECT_EQ(checksum(mirror_), checksums[static_cast<std::size_t>(i)]);
        EXPECT_EQ(checksum(milled_), checksum(mirror_));
    }
}

TEST_F(SessionControlsTest, ResetsManyStrokesInOneChangeOfEachBrick) {
    const std::uint64_t whole = checksum(milled_);
    for (int i = 0; i < 200; ++i) {
        for (int run = 0; run < 3; ++run) testing::carve_somewhere(milled_, random_, *this);
        frame(true);
        frame();
    }
    const std::uint64_t milled = checksum(milled_);
    ASSERT_GT(controls_.status().undo_steps, 150U);
    controls_.control({SessionAction::reset});
    frames(60);
    EXPECT_EQ(checksum(mirror_), whole);
    EXPECT_LE(gate_.restored_changes, milled_.content().brick_of_slot.size());
    // And all of it again, requested one by one.
    std::size_t left = controls_.status().redo_steps;
    while (left > 0) {
        for (std::size_t i = 0; i < std::min(left, ControlRunner::most_waiting); ++i)
            controls_.control({SessionAction::redo});
        frame();
        EXPECT_EQ(controls_.status().redo_steps, left - std::min(left, ControlRunner::most_waiting));
        left = controls_.status().redo_steps;
        frames(60);
    }
    EXPECT_EQ(checksum(milled_), milled);
    EXPECT_EQ(checksum(mirror_), milled);
    for (const ControlEvent& event : controls_.take_events()) EXPECT_FALSE(event.is_refused) << event.text;
}

TEST_F(SessionControlsTest, RefusesWhatThereIsNothingOf) {
    for (const auto action : {SessionAction::undo, SessionAction::redo, SessionAction::reset})
        controls_.control({action});
    frame();
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].text, "nothing is left to undo");
    EXPECT_EQ(events[1].text, "nothing is left to redo");
    for (const ControlEvent& event : events) EXPECT_TRUE(event.is_refused);
    EXPECT_FALSE(holds_still());
}

TEST_F(SessionControlsTest, PausesUntilItIsResumed) {
    controls_.control({SessionAction::pause});
    frame();
    EXPECT_TRUE(holds_still());
    EXPECT_TRUE(controls_.status().is_paused);
    frames(5);
    EXPECT_TRUE(holds_still());
    controls_.control({SessionAction::resume});
    frame();
    EXPECT_FALSE(holds_still());
}

TEST_F(SessionControlsTest, MarksSavesAndFinishesAndSaysWhatCameOfIt) {
    stroke();
    controls_.control({SessionAction::mark, "close to the nerve"});
    controls_.control({SessionAction::save});
    frame();
    can_save_ = false;
    controls_.control({SessionAction::save});
    controls_.control({SessionAction::finish});
    frame();
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[0].text, "close to the nerve");
    EXPECT_GT(events[0].time_s, 0.0);
    EXPECT_FALSE(events[1].is_refused);
    EXPECT_EQ(saved_, checksum(mirror_));
    EXPECT_TRUE(events[2].is_refused);
    EXPECT_EQ(events[2].text, "the disk is full");
    EXPECT_TRUE(is_finished_);
}

TEST_F(SessionControlsTest, SaysWhenSavingHasGoneWrongAlthoughNobodyAsks) {
    save_news_ = {"the folder is gone"};
    frame();
    frame();
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].action, SessionAction::save);
    EXPECT_EQ(events[0].text, "the folder is gone");
    EXPECT_TRUE(events[0].is_refused);
}

TEST_F(SessionControlsTest, TellsTheHapticLoopTheSpindlesSpeed) {
    controls_.control({.action = SessionAction::speed, .spindle_rpm = 30'000.0});
    frame();
    EXPECT_EQ(gate_.spindle_rpm, 30'000U);
    EXPECT_FALSE(holds_still());
    controls_.control({.action = SessionAction::speed, .spindle_rpm = 0.0});
    frame();
    EXPECT_EQ(gate_.spindle_rpm, 0U);
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].text, "30000 rpm");
    EXPECT_EQ(events[1].text, "each burr's own");
}

TEST_F(SessionControlsTest, SwitchesAFixtureWhileTheSessionIsPaused) {
    gate_.fixtures_on = 0b101;
    const auto ask = [&](const char* name, bool is_on) {
        controls_.control({.action = SessionAction::fixture, .text = name, .is_on = is_on});
        frame();
        return controls_.take_events().at(0);
    };
    controls_.control({SessionAction::pause});
    frame();
    controls_.take_events();
    const ControlEvent off = ask("Shaft", false);
    EXPECT_FALSE(off.is_refused);
    EXPECT_EQ(off.action, SessionAction::fixture);
    EXPECT_EQ(off.text, "Shaft: off");
    EXPECT_EQ(gate_.fixtures_on, 0b100U);
    EXPECT_EQ(ask("Off the nerve", true).text, "Off the nerve: on") << "as it was";
    EXPECT_EQ(gate_.fixtures_on, 0b100U);
    EXPECT_EQ(ask("Shaft", true).text, "Shaft: on");
    EXPECT_EQ(gate_.fixtures_on, 0b101U);
}

TEST_F(SessionControlsTest, SwitchesNoFixtureThatMovesAHandOrIsNotThere) {
    const auto refusal_of = [&](const char* name) {
        controls_.control({.action = SessionAction::fixture, .text = name, .is_on = true});
        frame();
        const ControlEvent event = controls_.take_events().at(0);
        EXPECT_TRUE(event.is_refused) << name;
        EXPECT_EQ(gate_.fixtures_on, 0U) << name;
        return event.text;
    };
    EXPECT_EQ(refusal_of("Shaft"), "pause the session first");
    const std::string choices = "; it has \"Shaft\", \"Off the nerve\"";
    EXPECT_EQ(refusal_of("shaft"), "the session has no fixture \"shaft\"" + choices);
    EXPECT_EQ(refusal_of(""), "the session has no fixture \"\"" + choices) << "one that cannot be switched";
}

TEST_F(SessionControlsTest, HasTheToolPlacedWhereItIsClearWhileTheSessionHoldsStill) {
    controls_.control({.action = SessionAction::place, .pose = {{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    frame();
    EXPECT_TRUE(holds_still());
    ASSERT_TRUE(placements_.refresh());
    EXPECT_EQ(placements_.front().number, 1U);
    EXPECT_EQ(placements_.front().pose.position_mm, glm::dvec3(1.0, 2.0, 4.0));
    frame();
    EXPECT_TRUE(controls_.take_events().empty());
    gate_.placed = 1;
    frame();
    EXPECT_FALSE(holds_still());
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].text, "at 1.0, 2.0, 4.0 mm LPS, 1.0 mm out of the bone");
    EXPECT_EQ(placed_->position_mm.z, 4.0);

    controls_.control({.action = SessionAction::place, .pose = {{101.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    frame();
    EXPECT_EQ(controls_.take_events().at(0).text, "too far");
    EXPECT_FALSE(holds_still());
}

TEST_F(SessionControlsTest, AnswersAllInTimeThoughNoArmIsThereToPlace) {
    controls_.control({.action = SessionAction::place, .pose = {{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    controls_.control({.action = SessionAction::place, .pose = {{2.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    controls_.control({SessionAction::mark, "behind"});
    controls_.control({SessionAction::save});
    controls_.control({SessionAction::finish});
    for (int i = 0; i < ControlRunner::longest_wait_frames; ++i) {
        EXPECT_TRUE(controls_.take_events().empty());
        frame();
    }
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 5U);
    EXPECT_TRUE(events[0].is_refused && events[1].is_refused);
    EXPECT_EQ(events[0].text, "force and spindle do not go off");
    EXPECT_EQ(events[2].text, "behind");
    EXPECT_FALSE(events[2].is_refused || events[3].is_refused || events[4].is_refused);
    EXPECT_TRUE(is_finished_);
    EXPECT_FALSE(holds_still());
    // The arm comes back: it is not placed any more.
    ASSERT_TRUE(placements_.refresh());
    EXPECT_EQ(placements_.front().number, gate_.placed);
    EXPECT_FALSE(placed_);
    controls_.control({.action = SessionAction::place, .pose = {{5.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    frame();
    ASSERT_TRUE(placements_.refresh());
    gate_.placed = placements_.front().number;
    frame();
    EXPECT_FALSE(controls_.take_events().at(0).is_refused);
    EXPECT_EQ(placed_->position_mm.x, 5.0);
}

TEST_F(SessionControlsTest, SaysWhatAPlacementWaitedFor) {
    controls_.control({.action = SessionAction::place, .pose = {{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    for (int i = 0; i < ControlRunner::longest_wait_frames; ++i) {
        controls_.begin_frame();
        controls_.end_frame(mirror_, {.time_s = 0.0, .fault = "the arm has gone"});
    }
    EXPECT_EQ(controls_.take_events().at(0).text, "the arm has gone");
    // Done at the last moment, it is done.
    controls_.control({.action = SessionAction::place, .pose = {{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}});
    for (int i = 0; i < ControlRunner::longest_wait_frames - 1; ++i) frame();
    gate_.placed = 2;
    frame();
    EXPECT_FALSE(controls_.take_events().at(0).is_refused);
}

TEST_F(SessionControlsTest, AnswersAllInTimeThoughTheLoopsStandStill) {
    stroke();
    controls_.control({SessionAction::undo});
    for (const auto action :
         {SessionAction::mark, SessionAction::redo, SessionAction::save, SessionAction::finish,
          SessionAction::pause, SessionAction::resume, SessionAction::speed})
        controls_.control({action});
    for (int i = 0; i < ControlRunner::longest_wait_frames; ++i) frame();  // and no step of the milling loop
    auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 8U);
    for (const ControlEvent& event : events) {
        const bool needs_bone = event.action == SessionAction::redo || event.action == SessionAction::save ||
                                event.action == SessionAction::finish;
        EXPECT_EQ(event.is_refused, needs_bone) << name_of(event.action);
        EXPECT_EQ(event.text == "the bone is still being given back", needs_bone);
    }
    EXPECT_TRUE(holds_still());
    frames(60);
    EXPECT_FALSE(holds_still());
    EXPECT_EQ(checksum(milled_), checksum(mirror_));
    // A spindle that nobody turns off.
    mill();
    controls_.control({SessionAction::undo});
    controls_.control({SessionAction::mark});
    for (int i = 0; i < ControlRunner::longest_wait_frames; ++i) frame(true);
    events = controls_.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].text, "the stroke under way does not end");
    EXPECT_FALSE(events[1].is_refused);
}

TEST_F(SessionControlsTest, TakesNoMoreThanItCanRemember) {
    for (int i = 0; i < 1000; ++i) controls_.control({SessionAction::mark});
    frame();
    const auto events = controls_.take_events();
    ASSERT_EQ(events.size(), 1000U);
    const auto refused = std::ranges::count_if(events, [](const auto& event) { return event.is_refused; });
    EXPECT_EQ(refused, 1000 - static_cast<std::ptrdiff_t>(ControlRunner::most_waiting));
}

TEST_F(SessionControlsTest, GoesOnThroughAQueueThatIsTooSmallForAStroke) {
    const std::uint64_t whole = checksum(milled_);
    for (int i = 0; i < 20; ++i) mill();  // every brick
    frame(true);
    frame();
    controls_.control({SessionAction::undo});
    frames(300);
    EXPECT_EQ(checksum(mirror_), whole);
    EXPECT_EQ(checksum(milled_), whole);
}

}  // namespace
}  // namespace osteomill
