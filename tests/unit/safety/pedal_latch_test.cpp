#include "simulation/safety/pedal_latch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace osteomill::pedal_latch_test {
namespace {

/// A loop that hears of a pedal: tick by tick on time that the test makes.
struct Loop {
    PedalDate date;
    PedalLatch latch;
    double now_s = 0.0;

    bool tick(const PedalStatement& said, double after_s = 0.001) {
        now_s += after_s;
        latch.tick(date.look(said, now_s), false);
        return latch.is_pressed();
    }
    /// Said at this very tick.
    bool tick(bool is_down, std::uint64_t speaker = 1, double after_s = 0.001) {
        return tick(PedalStatement{.is_down = is_down, .said_s = now_s + after_s, .speaker = speaker},
                    after_s);
    }
    Loop& press() {
        tick(false);
        EXPECT_TRUE(tick(true));
        return *this;
    }
};

TEST(PedalLatch, BeginsLockedUntilThePedalWasUp) {
    Loop loop;
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(loop.tick(true));
    EXPECT_TRUE(loop.latch.awaits_release());
    EXPECT_FALSE(loop.tick(false));
    EXPECT_FALSE(loop.latch.awaits_release());
    EXPECT_TRUE(loop.tick(true));
}

TEST(PedalLatch, KnowsNoPedalOfADeviceThatStatesNone) {
    Loop loop;
    loop.press();
    EXPECT_FALSE(loop.tick(PedalStatement{}));
    EXPECT_FALSE(loop.tick(PedalStatement{true}));
    EXPECT_FALSE(loop.tick(true)) << "silence is no release";
}

TEST(PedalLatch, TakesNoExpiryForARelease) {
    Loop loop;
    loop.press();
    const PedalStatement last{.is_down = true, .said_s = loop.now_s, .speaker = 1};
    while (loop.now_s - last.said_s < PedalDate::longest_age_s - 0.0015) ASSERT_TRUE(loop.tick(last));
    loop.tick(last, 0.003);
    EXPECT_FALSE(loop.latch.is_pressed());
    for (int i = 0; i < 500; ++i) ASSERT_FALSE(loop.tick(true)) << "heard again, and still held";
    EXPECT_FALSE(loop.tick(false));
    EXPECT_TRUE(loop.tick(true)) << "pressed anew";
}

TEST(PedalLatch, IsNotFreedByAnUpThatIsOld) {
    Loop loop;
    loop.press();
    loop.tick(PedalStatement{}, 1.0);
    EXPECT_FALSE(loop.tick(PedalStatement{.is_down = false, .said_s = loop.now_s - 0.5, .speaker = 1}));
    EXPECT_FALSE(loop.tick(true)) << "it lay in a queue while nobody looked";
}

TEST(PedalLatch, TakesALoopThatStoodStillForALapseHoweverFreshTheStatementIs) {
    Loop loop;
    loop.press();
    EXPECT_TRUE(loop.tick(true, 1, 0.9 * PedalDate::longest_age_s));
    EXPECT_FALSE(loop.tick(true, 1, 1.1 * PedalDate::longest_age_s));
    EXPECT_FALSE(loop.tick(true));
    loop.press();
    EXPECT_FALSE(loop.tick(false, 1, 5.0));
    EXPECT_TRUE(loop.tick(true)) << "up after the gap, and then pressed";
}

TEST(PedalLatch, IsNotHandedFromOneSpeakerToAnother) {
    Loop loop;
    loop.press();
    EXPECT_FALSE(loop.tick(true, 2)) << "without a millisecond between them";
    EXPECT_FALSE(loop.tick(true, 2));
    EXPECT_FALSE(loop.tick(true, 1)) << "nor back";
    EXPECT_FALSE(loop.tick(false, 1));
    EXPECT_TRUE(loop.tick(true, 1));
    EXPECT_FALSE(loop.tick(false, 2));
    EXPECT_TRUE(loop.tick(true, 2));
}

TEST(PedalLatch, LetsAPressCountLateAndAReleaseAtOnce) {
    Loop loop;
    const auto tick = [&](bool is_down, double acts_after_s) {
        return loop.tick(PedalStatement{
            .is_down = is_down, .said_s = loop.now_s, .speaker = 1, .acts_after_s = acts_after_s});
    };
    tick(false, 0.05);
    int waited = 0;
    while (!tick(true, 0.05)) ASSERT_LT(++waited, 60);
    EXPECT_NEAR(waited, 50, 1);
    EXPECT_TRUE(tick(true, 0.3)) << "what turns is not stopped by a delay that grew";
    EXPECT_FALSE(tick(false, 0.3));
    // A statement that waits frees nothing that is locked.
    loop.tick(PedalStatement{}, 0.5);
    for (int i = 0; i < 400; ++i) ASSERT_FALSE(tick(true, 0.05));
}

TEST(PedalLatch, TakesATimeThatIsNoNumberForALapse) {
    Loop loop;
    loop.press();
    EXPECT_FALSE(loop.tick(PedalStatement{.is_down = true, .said_s = std::nan(""), .speaker = 1}));
    EXPECT_FALSE(loop.tick(true));
    EXPECT_FALSE(loop.tick(PedalStatement{.is_down = false, .said_s = std::nan(""), .speaker = 1}));
    EXPECT_TRUE(loop.latch.is_locked());
}

TEST(PedalLatch, IsLockedByWhateverWithdrawsThePermission) {
    PedalLatch latch;
    latch.tick(PedalSeen::up, false);
    latch.tick(PedalSeen::down, false);
    ASSERT_TRUE(latch.is_pressed());
    latch.tick(PedalSeen::down, true);
    EXPECT_FALSE(latch.is_pressed());
    latch.tick(PedalSeen::down, false);
    EXPECT_TRUE(latch.awaits_release());
    latch.tick(PedalSeen::waiting, false);
    EXPECT_TRUE(latch.is_locked());
}

/// Every sequence of four things that a tick may see, from the start: the spindle turns only after an up that
/// nothing has followed but downs.
TEST(PedalLatch, TurnsOnlyAfterAnUpThatNothingElseHasFollowed) {
    const std::vector<PedalSeen> kinds{PedalSeen::lapsed, PedalSeen::up, PedalSeen::waiting, PedalSeen::down};
    for (int code = 0; code < 8 * 8 * 8 * 8 * 8; ++code) {
        PedalLatch latch;
        bool is_free = false;
        for (int rest = code, i = 0; i < 5; ++i, rest /= 8) {
            const PedalSeen seen = kinds[static_cast<std::size_t>(rest % 4)];
            const bool is_withdrawn = rest / 4 % 2 == 1;
            latch.tick(seen, is_withdrawn);
            is_free = seen == PedalSeen::up || (is_free && !is_withdrawn && seen != PedalSeen::lapsed);
            ASSERT_EQ(latch.is_pressed(), is_free && seen == PedalSeen::down) << code;
        }
    }
}

}  // namespace
}  // namespace osteomill::pedal_latch_test
