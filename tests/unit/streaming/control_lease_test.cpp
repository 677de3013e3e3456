#include <gtest/gtest.h>

#include "haptic_server/streaming/leases.h"

namespace osteomill {
namespace {

using std::chrono::seconds;

TEST(ControlLease, BelongsToTheFirstUntilItLeavesOrRests) {
    ControlLease lease;
    const ControlLease::Time now{};
    EXPECT_TRUE(lease.is_open_to(1, now));
    EXPECT_TRUE(lease.is_open_to(2, now));
    lease.use(1, now);
    EXPECT_TRUE(lease.is_open_to(1, now));
    EXPECT_FALSE(lease.is_open_to(2, now + seconds(30)));
    EXPECT_TRUE(lease.is_open_to(2, now + seconds(31)));
    lease.leave(2);
    EXPECT_FALSE(lease.is_open_to(2, now));
    lease.leave(1);
    EXPECT_TRUE(lease.is_open_to(2, now));
}

}  // namespace
}  // namespace osteomill
