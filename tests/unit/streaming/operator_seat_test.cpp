#include "haptic_server/streaming/operator_seat.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

using std::chrono::milliseconds;

class OperatorSeatTest : public ::testing::Test {
  protected:
    const OperatorInput& newest() {
        output_.refresh();
        return output_.front();
    }

    TripleBuffer<OperatorInput> output_;
    OperatorSeat seat_{output_};
    const OperatorSeat::Time start_{};
    const OperatorIntent pressed_{.hand_target_mm = {1, 2, 3}, .pedal = true, .burr = 2};
};

TEST_F(OperatorSeatTest, PublishesWhatTheOperatorWants) {
    EXPECT_FALSE(newest().present);
    EXPECT_TRUE(seat_.take_input(1, pressed_, start_));
    EXPECT_TRUE(newest().present);
    EXPECT_TRUE(newest().pedal);
    EXPECT_EQ(newest().burr, 2U);
    EXPECT_EQ(newest().hand_target.position_mm, glm::dvec3(1, 2, 3));
}

TEST_F(OperatorSeatTest, BelongsToTheFirstUntilItLeaves) {
    EXPECT_TRUE(seat_.take_input(1, pressed_, start_));
    EXPECT_FALSE(seat_.take_input(2, {.burr = 0}, start_));
    EXPECT_EQ(newest().burr, 2U);
    seat_.leave(2);
    EXPECT_TRUE(newest().present);
    seat_.leave(1);
    EXPECT_FALSE(newest().present);
    EXPECT_FALSE(newest().pedal);
    EXPECT_TRUE(seat_.take_input(2, {.burr = 1}, start_));
    EXPECT_EQ(newest().burr, 1U);
}

TEST_F(OperatorSeatTest, SaysNothingNewOnBehalfOfASilentOperator) {
    seat_.take_input(1, pressed_, start_);
    ASSERT_TRUE(output_.refresh());
    seat_.check_silence(start_ + milliseconds(900));
    EXPECT_FALSE(output_.refresh()) << "or the device would take it for fresh";
    EXPECT_FALSE(seat_.take_input(2, pressed_, start_ + milliseconds(900))) << "the seat is not free";
    seat_.check_silence(start_ + OperatorSeat::lease + milliseconds(1));
    EXPECT_FALSE(newest().present);
    EXPECT_FALSE(newest().pedal);
}

TEST_F(OperatorSeatTest, GoesToTheNextWhenItsLeaseRunsOut) {
    EXPECT_EQ(seat_.driver_for(1), ToolDriver::nobody);
    seat_.take_input(1, pressed_, start_);
    seat_.take_input(1, pressed_, start_ + milliseconds(1000));  // renews it
    EXPECT_EQ(seat_.driver_for(1), ToolDriver::you);
    EXPECT_EQ(seat_.driver_for(2), ToolDriver::another);
    const auto end = start_ + milliseconds(1000) + OperatorSeat::lease;
    seat_.check_silence(end);
    EXPECT_FALSE(seat_.take_input(2, pressed_, end));
    seat_.check_silence(end + milliseconds(1));
    EXPECT_EQ(seat_.driver_for(1), ToolDriver::nobody);
    EXPECT_TRUE(seat_.take_input(2, {.burr = 1}, end + milliseconds(1)));
    EXPECT_EQ(seat_.driver_for(1), ToolDriver::another);
    EXPECT_FALSE(seat_.take_input(1, pressed_, end + milliseconds(2)));
    EXPECT_EQ(newest().burr, 1U);
}

TEST_F(OperatorSeatTest, IsTakenOverAtTheEndOfTheLeaseWithoutWaitingForTheNextCheck) {
    seat_.take_input(1, pressed_, start_);
    EXPECT_TRUE(seat_.take_input(2, {.burr = 1}, start_ + OperatorSeat::lease + milliseconds(1)));
    EXPECT_EQ(seat_.driver_for(2), ToolDriver::you);
}

TEST_F(OperatorSeatTest, IsKeptByOneWhoRestsUntilAnotherAsksForIt) {
    const OperatorIntent resting{.hand_target_mm = {1, 2, 3}};
    auto now = start_;
    const auto rest_for = [&](std::chrono::seconds time) {
        for (const auto end = now + time; now < end; now += milliseconds(100))
            EXPECT_TRUE(seat_.take_input(1, resting, now));
    };
    rest_for(std::chrono::seconds(30));
    EXPECT_FALSE(seat_.take_input(2, pressed_, now)) << "not yet";
    rest_for(std::chrono::seconds(1));
    EXPECT_EQ(seat_.holder(), 1U);
    EXPECT_TRUE(seat_.take_input(2, pressed_, now));
    EXPECT_EQ(seat_.holder(), 2U);
    EXPECT_EQ(newest().burr, 2U);
    EXPECT_FALSE(seat_.take_input(1, resting, now)) << "the new one has just begun";
    now += OperatorSeat::lease;
    EXPECT_TRUE(seat_.take_input(2, {.burr = 1}, now));
    EXPECT_FALSE(seat_.take_input(1, resting, now + OperatorActivity::longest_rest / 10));
}

}  // namespace
}  // namespace osteomill
