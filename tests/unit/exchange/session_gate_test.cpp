#include "simulation/exchange/session_gate.h"

#include <gtest/gtest.h>

namespace osteomill::session_gate_test {
namespace {

TEST(StillnessRequest, LastsAsLongAsItIsWanted) {
    StillnessRequest request;
    EXPECT_FALSE(request.was_wanted());
    request.set(true);
    request.set(true);
    EXPECT_TRUE(request.is_wanted());
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(request.was_wanted());
    request.set(false);
    request.set(false);
    EXPECT_FALSE(request.is_wanted());
    EXPECT_FALSE(request.was_wanted()) << "it was seen while it lasted";
}

TEST(StillnessRequest, IsNotMissedByAReaderThatWasAway) {
    for (int times = 1; times < 4; ++times) {
        StillnessRequest request;
        for (int i = 0; i < times; ++i) {
            request.set(true);
            request.set(false);
        }
        EXPECT_TRUE(request.was_wanted());
        EXPECT_FALSE(request.was_wanted());
        request.set(true);
        EXPECT_TRUE(request.was_wanted());
        request.set(false);
        request.set(true);
        request.set(false);
        EXPECT_TRUE(request.was_wanted()) << "a second one, after the first was seen";
        EXPECT_FALSE(request.was_wanted());
    }
}

}  // namespace
}  // namespace osteomill::session_gate_test
