#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/safety/fault.h"

namespace osteomill::fault_set_test {
namespace {

TEST(FaultSet, KeepsEveryFaultByItself) {
    for (const Fault one : all_faults)
        for (const Fault other : all_faults) {
            FaultSet set(one);
            EXPECT_EQ(set.has(other), one == other);
            set.add(other);
            EXPECT_TRUE(set.has(one) && set.has(other));
            FaultSet in_other_order(other);
            in_other_order.add(one);
            EXPECT_EQ(set, in_other_order);
            EXPECT_EQ(set.first(), in_other_order.first());
            EXPECT_TRUE(set.first() == one || set.first() == other);
            EXPECT_EQ(set.withdraws_pedal(), withdraws_pedal(one) || withdraws_pedal(other));
        }
}

TEST(FaultSet, OfNoneIsEmpty) {
    FaultSet set(Fault::none);
    set.add(Fault::none);
    EXPECT_TRUE(set.is_empty());
    EXPECT_EQ(set, FaultSet());
    EXPECT_EQ(set.first(), Fault::none);
    EXPECT_FALSE(set.withdraws_pedal());
}

TEST(FaultSet, TellsOfEveryFaultInOneOrder) {
    for (const Fault fault : all_faults) EXPECT_EQ(std::ranges::count(told_first, fault), 1);
}

}  // namespace
}  // namespace osteomill::fault_set_test
