#include "simulation/device/permission.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteomill::permission_test {
namespace {

TEST(Permission, IsNotGivenBeforeTheFirstMessage) {
    const Permission permission;
    EXPECT_FALSE(permission.holds(0.0));
    EXPECT_FALSE(permission.holds(-1.0));
}

TEST(Permission, EndsByItselfSoLongAfterTheNewestMessage) {
    Permission permission;
    permission.renew(1.0);
    EXPECT_TRUE(permission.holds(1.0));
    EXPECT_TRUE(permission.holds(1.1999));
    EXPECT_FALSE(permission.holds(1.2001));
    permission.renew(1.15);
    EXPECT_TRUE(permission.holds(1.2001));
    EXPECT_FALSE(permission.holds(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Permission, EndsAtOnceWhereItIsWithdrawn) {
    Permission permission(0.03);
    permission.renew(5.0);
    permission.withdraw();
    EXPECT_FALSE(permission.holds(5.0));
    permission.renew(5.01);
    EXPECT_TRUE(permission.holds(5.03));
    EXPECT_FALSE(permission.holds(5.05));
}

}  // namespace
}  // namespace osteomill::permission_test
