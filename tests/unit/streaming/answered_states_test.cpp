#include <gtest/gtest.h>

#include "haptic_server/streaming/client_message.h"

namespace osteomill {
namespace {

using std::chrono::milliseconds;
using Answer = AnsweredStates::Answer;

class AnsweredStatesTest : public ::testing::Test {
  protected:
    static AnsweredStates::Time at(int ms) { return AnsweredStates::Time{} + milliseconds(ms); }
    AnsweredStates states_;
};

TEST_F(AnsweredStatesTest, LetsThroughWhatAnswersRecentNews) {
    for (int i = 0; i < 30; ++i) states_.sent(static_cast<std::uint64_t>(5 + i), at(33 * i));
    const int last_ms = 33 * 29;
    EXPECT_EQ(states_.judge(1, 34, at(last_ms)), Answer::fresh);
    EXPECT_EQ(states_.judge(2, 28, at(last_ms)), Answer::fresh) << "a round trip of 200 ms";
    EXPECT_EQ(states_.judge(3, 26, at(last_ms)), Answer::stale) << "264 ms";
    EXPECT_EQ(states_.judge(4, 5, at(last_ms)), Answer::stale) << "long forgotten";
    EXPECT_EQ(states_.judge(5, 2, at(last_ms)), Answer::stale) << "no state, but sent before";
}

TEST_F(AnsweredStatesTest, TakesAnswersToTheNewestForAsLongAsItIsTrue) {
    states_.sent(5, at(0));
    for (int ms = 33; ms <= 990; ms += 33) states_.still_true(at(ms));
    EXPECT_EQ(states_.judge(1, 5, at(1200)), Answer::fresh);
    states_.sent(6, at(1201));
    EXPECT_EQ(states_.judge(2, 5, at(1202)), Answer::fresh);
    EXPECT_EQ(states_.judge(3, 5, at(1241)), Answer::stale);
    EXPECT_EQ(states_.judge(4, 6, at(1241)), Answer::fresh);
}

TEST_F(AnsweredStatesTest, PassesOverWhatIsSaidTwiceOrOvertaken) {
    states_.sent(5, at(0));
    EXPECT_EQ(states_.judge(3, 5, at(1)), Answer::fresh);
    EXPECT_EQ(states_.judge(3, 5, at(1)), Answer::repeated);
    EXPECT_EQ(states_.judge(2, 5, at(1)), Answer::repeated);
    EXPECT_FALSE(states_.is_news());
    EXPECT_EQ(states_.judge(9, 5, at(1)), Answer::fresh);
    EXPECT_EQ(states_.judge(0, 5, at(1)), Answer::repeated) << "inputs count from 1";
}

TEST_F(AnsweredStatesTest, KnowsWhatNamesNoStateOrOneThatWasNeverSent) {
    EXPECT_EQ(states_.judge(0, 0, at(0)), Answer::unnamed);
    EXPECT_EQ(states_.judge(1, 5, at(0)), Answer::unsent);
    states_.sent(5, at(0));
    EXPECT_EQ(states_.judge(2, 6, at(0)), Answer::unsent);
}

TEST_F(AnsweredStatesTest, TellsNewsOnce) {
    states_.sent(5, at(0));
    states_.judge(1, 5, at(1));
    EXPECT_FALSE(states_.is_news()) << "nobody need be told that all is well";
    states_.judge(2, 5, at(400));
    EXPECT_TRUE(states_.is_news());
    states_.judge(3, 5, at(401));
    EXPECT_FALSE(states_.is_news());
    states_.still_true(at(402));
    states_.judge(4, 5, at(403));
    EXPECT_TRUE(states_.is_news());
}

TEST_F(AnsweredStatesTest, KeepsNoMoreThanItNeeds) {
    for (std::uint64_t number = 5; number < 100'000; ++number) states_.sent(number, at(0));
    EXPECT_EQ(states_.judge(1, 99'999, at(0)), Answer::fresh);
    EXPECT_EQ(states_.judge(2, 5, at(0)), Answer::stale);
}

}  // namespace
}  // namespace osteomill
