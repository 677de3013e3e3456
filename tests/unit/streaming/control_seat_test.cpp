#include "haptic_server/streaming/control_seat.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

using std::chrono::seconds;

TEST(ControlSeat, BelongsToTheFirstUntilItLeavesOrRests) {
    ControlSeat seat;
    const ControlSeat::Time now{};
    EXPECT_TRUE(seat.is_open_to(1, now));
    EXPECT_TRUE(seat.is_open_to(2, now));
    seat.use(1, now);
    EXPECT_TRUE(seat.is_open_to(1, now));
    EXPECT_FALSE(seat.is_open_to(2, now + seconds(30)));
    EXPECT_TRUE(seat.is_open_to(2, now + seconds(31)));
    seat.leave(2);
    EXPECT_FALSE(seat.is_open_to(2, now));
    seat.leave(1);
    EXPECT_TRUE(seat.is_open_to(2, now));
}

}  // namespace
}  // namespace osteomill
