#include "haptic_server/streaming/leases.h"

#include <gtest/gtest.h>

#include <functional>

namespace osteomill {
namespace {

using std::chrono::milliseconds;

class ToolLeaseTest : public ::testing::Test {
  protected:
    const std::optional<OperatorCommand>& newest() {
        output_.refresh();
        return output_.front().command;
    }

    OperatorChannel output_;
    ToolLease lease_{output_};
    const ToolLease::Time start_{};
    const OperatorCommand pressed_{.hand_target_mm = {1, 2, 3}, .pedal = true, .burr = 2};
};

TEST_F(ToolLeaseTest, PublishesWhatTheOperatorWants) {
    EXPECT_FALSE(newest());
    EXPECT_TRUE(lease_.take_input(1, pressed_, start_));
    EXPECT_EQ(newest(), pressed_);
}

TEST_F(ToolLeaseTest, CountsTheHoldersReleasesForAReaderOfTheNewestCommandAlone) {
    const OperatorCommand released{.hand_target_mm = {1, 2, 3}, .burr = 2};
    lease_.take_input(1, released, start_);
    lease_.take_input(1, pressed_, start_);
    lease_.take_input(2, released, start_);
    output_.refresh();
    EXPECT_EQ(output_.front().releases, 1U) << "another's are not heard";
    lease_.leave(1);
    lease_.take_input(2, pressed_, start_);
    output_.refresh();
    EXPECT_EQ(output_.front().releases, 0U) << "it has released nothing yet";
}

TEST_F(ToolLeaseTest, BelongsToTheFirstUntilItLeaves) {
    EXPECT_TRUE(lease_.take_input(1, pressed_, start_));
    EXPECT_FALSE(lease_.take_input(2, {.burr = 0}, start_));
    EXPECT_EQ(newest()->burr, 2U);
    lease_.leave(2);
    EXPECT_TRUE(newest());
    lease_.leave(1);
    EXPECT_FALSE(newest());
    EXPECT_TRUE(lease_.take_input(2, {.burr = 1}, start_));
    EXPECT_EQ(newest()->burr, 1U);
}

TEST_F(ToolLeaseTest, SaysNothingNewOnBehalfOfASilentOperator) {
    lease_.take_input(1, pressed_, start_);
    ASSERT_TRUE(output_.refresh());
    lease_.check_silence(start_ + milliseconds(900));
    EXPECT_FALSE(output_.refresh()) << "or the device would take it for fresh";
    EXPECT_FALSE(lease_.take_input(2, pressed_, start_ + milliseconds(900))) << "the tool is not free";
    lease_.check_silence(start_ + ToolLease::duration + milliseconds(1));
    EXPECT_FALSE(newest());
}

TEST_F(ToolLeaseTest, GoesToTheNextWhenItsLeaseRunsOut) {
    EXPECT_EQ(lease_.driver_for(1), ToolDriver::nobody);
    lease_.take_input(1, pressed_, start_);
    lease_.take_input(1, pressed_, start_ + milliseconds(1000));  // renews it
    EXPECT_EQ(lease_.driver_for(1), ToolDriver::you);
    EXPECT_EQ(lease_.driver_for(2), ToolDriver::another);
    const auto end = start_ + milliseconds(1000) + ToolLease::duration;
    lease_.check_silence(end);
    EXPECT_FALSE(lease_.take_input(2, pressed_, end));
    lease_.check_silence(end + milliseconds(1));
    EXPECT_EQ(lease_.driver_for(1), ToolDriver::nobody);
    EXPECT_TRUE(lease_.take_input(2, {.burr = 1}, end + milliseconds(1)));
    EXPECT_EQ(lease_.driver_for(1), ToolDriver::another);
    EXPECT_FALSE(lease_.take_input(1, pressed_, end + milliseconds(2)));
    EXPECT_EQ(newest()->burr, 1U);
}

TEST_F(ToolLeaseTest, IsTakenOverAtTheEndOfTheLeaseWithoutWaitingForTheNextCheck) {
    lease_.take_input(1, pressed_, start_);
    EXPECT_TRUE(lease_.take_input(2, {.burr = 1}, start_ + ToolLease::duration + milliseconds(1)));
    EXPECT_EQ(lease_.driver_for(2), ToolDriver::you);
}

TEST_F(ToolLeaseTest, IsKeptByOneWhoRestsUntilAnotherAsksForIt) {
    const OperatorCommand resting{.hand_target_mm = {1, 2, 3}};
    auto now = start_;
    const auto rest_for = [&](std::chrono::seconds time) {
        for (const auto end = now + time; now < end; now += milliseconds(100))
            EXPECT_TRUE(lease_.take_input(1, resting, now));
    };
    rest_for(std::chrono::seconds(30));
    EXPECT_FALSE(lease_.take_input(2, pressed_, now)) << "not yet";
    rest_for(std::chrono::seconds(1));
    EXPECT_EQ(lease_.holder(), 1U);
    EXPECT_TRUE(lease_.take_input(2, pressed_, now));
    EXPECT_EQ(lease_.holder(), 2U);
    EXPECT_EQ(newest()->burr, 2U);
    EXPECT_FALSE(lease_.take_input(1, resting, now)) << "the new one has just begun";
    now += ToolLease::duration;
    EXPECT_TRUE(lease_.take_input(2, {.burr = 1}, now));
    EXPECT_FALSE(lease_.take_input(1, resting, now + ControlLease::longest_rest / 10));
}

TEST_F(ToolLeaseTest, IsKeptByAnythingNewAndByAPedalThatIsDown) {
    OperatorCommand command{.hand_target_mm = {1, 2, 3}, .burr = 1};
    auto now = start_;
    for (const auto& change : std::initializer_list<std::function<void(OperatorCommand&)>>{
             [](OperatorCommand& moved) { moved.hand_target_mm.x += 0.01; },
             [](OperatorCommand& turned) {
                 turned.spindle_axis = {0, 1, 0};
             },
             [](OperatorCommand& other) { other.burr = 0; },
             [](OperatorCommand& pressed) { pressed.pedal = true; },
             [](OperatorCommand&) {},  // it is down still
             [](OperatorCommand& released) { released.pedal = false; }}) {
        for (int i = 0; i < 31; ++i) lease_.take_input(1, command, now += std::chrono::seconds(1));
        change(command);
        EXPECT_TRUE(lease_.take_input(1, command, now));
        EXPECT_FALSE(lease_.take_input(2, {}, now));
    }
}

}  // namespace
}  // namespace osteomill
