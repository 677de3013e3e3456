#include "common/log/rate_limit.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(TokenBucket, GivesWhatWasSavedUpAtOnceAndThenSoManyASecond) {
    const TokenBucket::Time start{};
    TokenBucket bucket(2.0, 3.0);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(bucket.take(start));
    EXPECT_FALSE(bucket.take(start));
    EXPECT_FALSE(bucket.take(start + milliseconds(499)));
    EXPECT_TRUE(bucket.take(start + milliseconds(500)));
    EXPECT_FALSE(bucket.take(start + milliseconds(500)));
}

TEST(TokenBucket, SavesNoMoreThanItHolds) {
    const TokenBucket::Time start{};
    TokenBucket bucket(2.0, 3.0);
    int taken = 0;
    while (bucket.take(start + seconds(3600))) ++taken;
    EXPECT_EQ(taken, 3);
}

}  // namespace
}  // namespace osteomill
