#include "devices/tracker/sampled_motion.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>
#include <vector>

namespace osteomill::sampled_motion_test {
namespace {

constexpr double tick_s = 0.001;
constexpr double clock_apart_s = 1.7e9;  // the sender tells the time of day

/// A hand's circle: 2 mm, once a second, while it turns about the same axis.
glm::dvec3 circle_mm(double time_s) {
    const double angle = glm::two_pi<double>() * time_s;
    return {2.0 * std::cos(angle), 2.0 * std::sin(angle), 5.0};
}
glm::dquat turn_at(double time_s) {
    return glm::angleAxis(glm::two_pi<double>() * time_s, glm::dvec3(0.0, 0.0, 1.0));
}

struct Link {
    double rate_hz = 100.0;
    double jitter_s = 0.0;  ///< each sample is late by up to this, in order
    double lost = 0.0;
    bool has_stamps = true;
};

struct Played {
    std::vector<double> true_time_s;  // the time in the motion at which it was there
    std::vector<SampledMotion::Pose> poses;
    double delay_s = 0.0;
    int absent = 0;  ///< ticks without a pose after the first
};

template <typename Motion>
Played play(const Link& link, double duration_s, Motion&& where) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<SampledMotion::Sample> sent;
    double arrival_s = 0.0;
    for (int i = 0; i / link.rate_hz < duration_s; ++i) {
        const double time_s = i / link.rate_hz;
        arrival_s = std::max(arrival_s, time_s + 0.003 + link.jitter_s * share(random));
        if (share(random) < link.lost) continue;
        sent.push_back({.stamp_s = link.has_stamps ? clock_apart_s + time_s : 0.0,
                        .arrival_s = arrival_s,
                        .position_mm = where(time_s),
                        .turn = turn_at(time_s)});
    }
    SampledMotion motion;
    Played played;
    std::size_t next = 0;
    for (int tick = 0; tick * tick_s < duration_s; ++tick) {
        const double now_s = tick * tick_s;
        for (; next < sent.size() && sent[next].arrival_s <= now_s; ++next) {
            SampledMotion::Sample sample = sent[next];
            sample.arrival_s = now_s;
            motion.take(sample);
        }
        const auto pose = motion.at(now_s);
        if (pose) {
            played.poses.push_back(*pose);
        } else if (!played.poses.empty()) {
            ++played.absent;
        }
    }
    played.delay_s = motion.delay_s();
    return played;
}

double off_the_circle_mm(const glm::dvec3& position_mm) {
    return std::hypot(std::hypot(position_mm.x, position_mm.y) - 2.0, position_mm.z - 5.0);
}

TEST(SampledMotion, StaysOnTheWayAtAnyRateAndJitter) {
    for (const Link& link : {Link{20.0}, Link{60.0}, Link{250.0}, Link{500.0}, Link{20.0, 0.02},
                             Link{60.0, 0.03}, Link{250.0, 0.03}, Link{500.0, 0.03}, Link{60.0, 0.02, 0.2}}) {
        const Played played = play(link, 4.0, circle_mm);
        EXPECT_EQ(played.absent, 0) << link.rate_hz;
        ASSERT_GT(played.poses.size(), 3000u);
        double largest_mm = 0.0;
        double longest_step_mm = 0.0;
        for (std::size_t i = 1; i < played.poses.size(); ++i) {
            largest_mm = std::max(largest_mm, off_the_circle_mm(played.poses[i].position_mm));
            longest_step_mm = std::max(
                longest_step_mm, glm::distance(played.poses[i].position_mm, played.poses[i - 1].position_mm));
        }
        EXPECT_LT(largest_mm, link.lost > 0.0 ? 0.06 : 0.01) << link.rate_hz;
        // 12.6 mm/s, and catching up.
        EXPECT_LT(longest_step_mm, 1.05 * SampledMotion::catch_up * 0.0126) << link.rate_hz << link.jitter_s;
    }
}

TEST(SampledMotion, IsSteadyOnceItKnowsTheJitter) {
    const Played played = play({.rate_hz = 100.0, .jitter_s = 0.02}, 8.0, circle_mm);
    for (std::size_t i = played.poses.size() - 3000; i < played.poses.size(); ++i) {
        const double step_mm = glm::distance(played.poses[i].position_mm, played.poses[i - 1].position_mm);
        EXPECT_NEAR(step_mm, 0.01257, 0.0015);
        EXPECT_NEAR(glm::length(played.poses[i].velocity_mm_per_s), 12.57, 1.5);
    }
}

TEST(SampledMotion, IsLateByTwoPeriodsAndTheJitter) {
    EXPECT_NEAR(play({.rate_hz = 100.0}, 3.0, circle_mm).delay_s, 0.02, 0.002);
    EXPECT_NEAR(play({.rate_hz = 20.0}, 3.0, circle_mm).delay_s, 0.1, 0.002);
    EXPECT_NEAR(play({.rate_hz = 500.0}, 3.0, circle_mm).delay_s, 0.004, 0.002);
    const double with_jitter_s = play({.rate_hz = 100.0, .jitter_s = 0.03}, 3.0, circle_mm).delay_s;
    EXPECT_GT(with_jitter_s, 0.03);
    EXPECT_LT(with_jitter_s, 0.055);
}

TEST(SampledMotion, TurnsAsTheHandDoes) {
    const Played played = play({.rate_hz = 50.0, .jitter_s = 0.01}, 3.0, circle_mm);
    for (const SampledMotion::Pose& pose : played.poses) {
        const double of_position = std::atan2(pose.position_mm.y, pose.position_mm.x);
        const glm::dvec3 axis = pose.turn * glm::dvec3(1.0, 0.0, 0.0);
        EXPECT_LT(glm::distance(axis, glm::dvec3(std::cos(of_position), std::sin(of_position), 0.0)), 0.01);
    }
}

TEST(SampledMotion, IsTheSameWayWithoutStamps) {
    const Played played = play({.rate_hz = 60.0, .jitter_s = 0.02, .has_stamps = false}, 4.0, circle_mm);
    EXPECT_EQ(played.absent, 0);
    double largest_mm = 0.0;
    for (const SampledMotion::Pose& pose : played.poses)
        largest_mm = std::max(largest_mm, off_the_circle_mm(pose.position_mm));
    EXPECT_LT(largest_mm, 0.05);
}

TEST(SampledMotion, StandsWhereSamplesEndAndIsThenLost) {
    SampledMotion motion;
    double now_s = 0.0;
    for (; now_s < 1.0; now_s += tick_s) {
        if (std::fmod(now_s + 1e-9, 0.01) < tick_s)
            motion.take(
                {.stamp_s = now_s + 5.0, .arrival_s = now_s, .position_mm = {30.0 * now_s, 0.0, 0.0}});
        motion.at(now_s);
    }
    double lost_s = 0.0;
    for (; now_s < 2.0 && lost_s == 0.0; now_s += tick_s) {
        const auto pose = motion.at(now_s);
        if (!pose) lost_s = now_s;
        if (!pose) break;
        EXPECT_LE(pose->position_mm.x, 30.0) << "nothing beyond what was measured";
    }
    EXPECT_NEAR(lost_s, 1.0 + SampledMotion::least_silence_s - 0.01, 0.005);
    // Back elsewhere: begins there, without a way between.
    for (int i = 0; i < 3; ++i)
        motion.take(
            {.stamp_s = 7.0 + 0.01 * i, .arrival_s = 2.0 + 0.01 * i, .position_mm = {-50.0, 0.0, 0.0}});
    ASSERT_TRUE(motion.at(2.03));
    EXPECT_EQ(motion.at(2.031)->position_mm.x, -50.0);
}

TEST(SampledMotion, IsLostAfterFivePeriodsButNoLaterThanAQuarterSecond) {
    for (const auto& [period_s, silence_s] :
         {std::pair(0.002, 0.05), std::pair(0.02, 0.1), std::pair(0.05, 0.25), std::pair(0.2, 0.25)}) {
        SampledMotion motion;
        for (int i = 0; i < 20; ++i) motion.take({.stamp_s = 1.0 + i * period_s, .arrival_s = i * period_s});
        const double last_s = 19 * period_s;
        EXPECT_TRUE(motion.at(last_s + silence_s - 0.002)) << period_s;
        EXPECT_FALSE(motion.at(last_s + silence_s + 0.002)) << period_s;
    }
}

TEST(SampledMotion, TakesOldAndRepeatedSamplesForNone) {
    SampledMotion motion;
    for (int i = 0; i < 10; ++i) motion.take({.stamp_s = 1.0 + 0.01 * i, .arrival_s = 0.01 * i});
    for (int i = 0; i < 10; ++i) {
        motion.take({.stamp_s = 1.09, .arrival_s = 0.1 + 0.02 * i, .position_mm = glm::dvec3(9.0)});
        motion.take({.stamp_s = 1.05, .arrival_s = 0.1 + 0.02 * i, .position_mm = glm::dvec3(9.0)});
    }
    EXPECT_FALSE(motion.at(0.3)) << "a tracker that repeats itself tells nothing";
}

TEST(SampledMotion, BeginsAnewWhereAClockWasSet) {
    SampledMotion motion;
    for (int i = 0; i < 10; ++i) motion.take({.stamp_s = 100.0 + 0.01 * i, .arrival_s = 0.01 * i});
    ASSERT_TRUE(motion.at(0.1));
    for (int i = 0; i < 3; ++i)
        motion.take({.stamp_s = 7.0 + 0.01 * i, .arrival_s = 0.1 + 0.01 * i, .position_mm = glm::dvec3(1.0)});
    ASSERT_TRUE(motion.at(0.13));
    EXPECT_EQ(motion.at(0.131)->position_mm, glm::dvec3(1.0));
}

TEST(SampledMotion, FollowsClocksThatDrift) {
    // 300 ppm either way, for two minutes.
    for (const double rate : {1.0 + 3e-4, 1.0 - 3e-4}) {
        SampledMotion motion;
        for (int i = 0; i < 12'000; ++i) {
            const double now_s = 0.01 * i;
            motion.take(
                {.stamp_s = 50.0 + rate * now_s, .arrival_s = now_s, .position_mm = {now_s, 0.0, 0.0}});
            const auto pose = motion.at(now_s + 0.005);
            if (i > 10) {
                ASSERT_TRUE(pose);
                EXPECT_NEAR(pose->position_mm.x, now_s, 0.04);
            }
        }
        EXPECT_LT(motion.delay_s(), 0.03);
    }
}

/// A hand that goes steadily, sampled by a tracker whose clock, or whose link, is not ours.
struct OddClock {
    const char* name;
    double rate_hz;
    std::function<double(double)> stamp_s;  ///< for a sample made at a time of ours
    std::function<double(double)> arrival_s = [](double made_s) { return made_s + 0.003; };
};

struct Followed {
    double oldest_s = 0.0;  ///< largest age of the played pose beyond the stated delay
    int losses = 0;         ///< after the first pose
    int present = 0;        ///< ticks with a pose
    bool is_there_at_end = false;
    bool has_told_of_clock = false;
};

Followed follow(const OddClock& clock, double duration_s = 20.0) {
    constexpr double speed_mm_per_s = 20.0;
    SampledMotion motion;
    Followed followed;
    int next = 0;
    bool was_there = false;
    for (int tick = 0; tick * tick_s < duration_s; ++tick) {
        const double now_s = tick * tick_s;
        for (; clock.arrival_s(next / clock.rate_hz) <= now_s; ++next) {
            const double made_s = next / clock.rate_hz;
            motion.take({.stamp_s = clock.stamp_s(made_s),
                         .arrival_s = now_s,
                         .position_mm = {speed_mm_per_s * made_s, 0.0, 0.0}});
        }
        const auto pose = motion.at(now_s);
        followed.has_told_of_clock |= motion.clock_fault() != SampledMotion::ClockFault::none;
        if (was_there && !pose) ++followed.losses;
        was_there = followed.is_there_at_end = pose.has_value();
        if (!pose) continue;
        ++followed.present;
        const double age_s = now_s - pose->position_mm.x / speed_mm_per_s;
        followed.oldest_s = std::max(followed.oldest_s, age_s - motion.delay_s());
    }
    return followed;
}

std::vector<OddClock> odd_clocks() {
    std::vector<OddClock> clocks;
    const double epoch_s = 1e9;
    for (const double rate_hz : {20.0, 60.0, 100.0, 250.0}) {
        for (const double rate : {0.2, 0.5, 0.8, 0.95, 1.1, 1.3, 1.6, 2.0, 3.0, 5.0, 100.0})
            clocks.push_back({"another rate", rate_hz, [=](double at_s) { return epoch_s + rate * at_s; }});
        for (const double set_s : {-100.0, -0.9, -0.3, 0.3, 0.9, 100.0})
            clocks.push_back({"jumps", rate_hz, [=](double at_s) {
                                  return epoch_s + at_s + (std::fmod(at_s, 4.0) > 2.0 ? set_s : 0.0);
                              }});
        for (const double range_s : {0.5, 3.0})
            clocks.push_back({"wraps", rate_hz, [=](double at_s) { return 1.0 + std::fmod(at_s, range_s); }});
        clocks.push_back({"stands", rate_hz, [=](double at_s) { return epoch_s + std::min(at_s, 3.0); }});
        clocks.push_back({"gains more and more", rate_hz,
                          [=](double at_s) { return epoch_s + at_s + 0.05 * at_s * at_s; }});
        clocks.push_back({"loses more and more", rate_hz,
                          [=](double at_s) { return epoch_s + at_s - 0.01 * at_s * at_s; }});
        clocks.push_back({"grows old on the way", rate_hz, [=](double at_s) { return epoch_s + at_s; },
                          [](double made_s) { return 1.1 * made_s; }});
    }
    return clocks;
}

TEST(SampledMotion, IsNeverFarBehindTheHandWhateverTheSendersClockDoes) {
    for (const OddClock& clock : odd_clocks()) {
        const Followed followed = follow(clock);
        // In addition to the allowed motion, by the steps of samples; and if none comes, by the silence.
        const double step_s = 1.0 / clock.rate_hz;
        const double silence_s =
            std::clamp(5.0 * step_s, SampledMotion::least_silence_s, SampledMotion::most_silence_s);
        EXPECT_LE(followed.oldest_s, std::max(SampledMotion::longest_behind_s + step_s, silence_s) + 0.005)
            << clock.name << " at " << clock.rate_hz << " Hz";
        EXPECT_LE(followed.losses, 40) << clock.name << " at " << clock.rate_hz << " Hz: comes and goes";
    }
}

TEST(SampledMotion, IsLostAndSaysSoWhileTheSendersClockRunsAtAnotherRate) {
    for (const double rate : {0.2, 0.5, 0.9, 1.1, 2.0, 5.0}) {
        const Followed followed =
            follow({"another rate", 100.0, [=](double at_s) { return 1e9 + rate * at_s; }});
        EXPECT_FALSE(followed.is_there_at_end) << rate;
        EXPECT_TRUE(followed.has_told_of_clock) << rate;
        EXPECT_LE(followed.losses, 2) << rate;
    }
    const Followed old = follow({"grows old on the way", 100.0, [](double at_s) { return 1e9 + at_s; },
                                 [](double made_s) { return 1.1 * made_s; }});
    EXPECT_FALSE(old.is_there_at_end);
    EXPECT_TRUE(old.has_told_of_clock);
}

TEST(SampledMotion, IsBackWhenTheSendersClockIsRightAgain) {
    for (const double rate : {0.3, 3.0})
        EXPECT_TRUE(follow({"mends", 100.0,
                            [=](double at_s) {
                                const double odd_s = std::clamp(at_s - 5.0, 0.0, 0.3);
                                return 1e9 + at_s + (rate - 1.0) * odd_s;
                            }})
                        .is_there_at_end)
            << rate;
}

/// Plays `samples` as they come and gives how far the burr was from the nearest of all straight lines between
/// two that follow each other, at the most.
double farthest_from_its_samples_mm(const std::vector<SampledMotion::Sample>& samples) {
    SampledMotion motion;
    std::size_t next = 0;
    double farthest_mm = 0.0;
    for (double now_s = 0.0; now_s < samples.back().arrival_s + 0.5; now_s += tick_s) {
        for (; next < samples.size() && samples[next].arrival_s <= now_s; ++next) motion.take(samples[next]);
        const auto pose = motion.at(now_s);
        if (!pose) continue;
        EXPECT_TRUE(std::isfinite(glm::length(pose->velocity_mm_per_s)));
        double nearest_mm = 1e9;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const glm::dvec3 from = samples[i - 1].position_mm, way = samples[i].position_mm - from;
            const double squared = glm::dot(way, way);
            const double share = squared > 0.0 ? glm::dot(pose->position_mm - from, way) / squared : 0.0;
            nearest_mm = std::min(nearest_mm,
                                  glm::distance(pose->position_mm, from + std::clamp(share, 0.0, 1.0) * way));
        }
        farthest_mm = std::max(farthest_mm, nearest_mm);
    }
    return farthest_mm;
}

TEST(SampledMotion, FollowsNoSlopeOfSamplesCloserThanTheTrackersNoise) {
    for (const double apart_s : {1e-9, 5e-5, 1e-3, 2e-3}) {
        std::vector<SampledMotion::Sample> samples;
        for (int i = 0; i < 300; ++i) {
            const double time_s = 0.01 * i;
            const glm::dvec3 position_mm(1.5 * std::sin(3.0 * time_s), 0.0,
                                         std::max(5.0, 10.0 - 4.0 * time_s));
            samples.push_back({.stamp_s = 9.0 + time_s, .arrival_s = time_s, .position_mm = position_mm});
            if (i % 25 == 0)
                samples.push_back({.stamp_s = 9.0 + time_s + apart_s,
                                   .arrival_s = time_s,
                                   .position_mm = position_mm + glm::dvec3(0.0, 0.0, 0.2)});
        }
        EXPECT_LE(farthest_from_its_samples_mm(samples), SampledMotion::most_bulge_mm + 1e-9) << apart_s;
    }
}

/// Samples of a hand that is as fast as hands are, at odd times.
std::vector<SampledMotion::Sample> wild_samples(std::mt19937& random) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::vector<SampledMotion::Sample> samples{{.stamp_s = 3.0}};
    for (int i = 0; i < 200; ++i) {
        const double span_s = std::pow(10.0, -2.0 + share(random)) + SampledMotion::least_apart_s;
        SampledMotion::Sample next = samples.back();
        next.stamp_s += span_s;
        next.arrival_s += span_s;
        next.position_mm += glm::dvec3(share(random), share(random), share(random)) * (250.0 * span_s);
        samples.push_back(next);
    }
    return samples;
}

TEST(SampledMotion, StaysByItsSamplesHoweverTheHandJerks) {
    std::mt19937 random(17);
    for (int run = 0; run < 30; ++run)
        EXPECT_LE(farthest_from_its_samples_mm(wild_samples(random)), SampledMotion::most_bulge_mm + 1e-9);
}

TEST(SampledMotion, StaysAmongItsSamplesWhateverTheirStampsAre) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int run = 0; run < 40; ++run) {
        std::vector<SampledMotion::Sample> samples = wild_samples(random);
        glm::dvec3 least_mm(0.0), most_mm(0.0);
        SampledMotion motion;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            SampledMotion::Sample& sample = samples[i];
            if (run % 4 == 0) sample.stamp_s = 0.0;                     // none
            if (run % 4 == 1) sample.stamp_s = 3.0;                     // stands still
            if (run % 4 == 2) sample.stamp_s = 9.0 - sample.arrival_s;  // runs backwards
            if (run % 4 == 3) sample.stamp_s += 0.05 * share(random);   // to and fro
            least_mm = glm::min(least_mm, sample.position_mm);
            most_mm = glm::max(most_mm, sample.position_mm);
            motion.take(sample);
            const auto pose = motion.at(sample.arrival_s);
            if (!pose) continue;
            EXPECT_NE(run % 4, 1) << "no time, no motion";
            EXPECT_NE(run % 4, 2);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(pose->position_mm[axis], least_mm[axis] - SampledMotion::most_bulge_mm);
                EXPECT_LE(pose->position_mm[axis], most_mm[axis] + SampledMotion::most_bulge_mm);
            }
        }
    }
}

TEST(SampledMotion, PassesOverOneSampleThatNoHandReachesAndIsLostAtTwo) {
    for (const int strange : {1, 2}) {
        SampledMotion motion;
        bool was_lost = false;
        for (int tick = 0; tick < 600; ++tick) {
            const double now_s = tick * tick_s;
            if (tick % 10 == 0) {
                const int i = tick / 10;
                const bool is_strange = i >= 30 && i < 30 + strange;
                motion.take({.stamp_s = 5.0 + now_s,
                             .arrival_s = now_s,
                             .position_mm = {0.0, 0.0, is_strange ? -25.0 : 5.0}});
            }
            const auto pose = motion.at(now_s);
            if (tick > 40 && !pose) was_lost = true;
            if (!pose) continue;
            EXPECT_EQ(pose->position_mm.z, 5.0) << "no way to there and back";
        }
        EXPECT_EQ(was_lost, strange == 2);
        EXPECT_TRUE(motion.at(0.6)) << "and is back";
    }
}

TEST(SampledMotion, IsLostWhereTheMarkerTurnsAsNoHandDoes) {
    SampledMotion motion;
    for (int i = 0; i < 20; ++i) motion.take({.stamp_s = 1.0 + 0.01 * i, .arrival_s = 0.01 * i});
    ASSERT_TRUE(motion.at(0.19));
    const glm::dquat over = glm::angleAxis(2.0, glm::dvec3(1.0, 0.0, 0.0));
    motion.take({.stamp_s = 1.2, .arrival_s = 0.2, .turn = over});
    ASSERT_TRUE(motion.at(0.2));
    motion.take({.stamp_s = 1.21, .arrival_s = 0.21, .turn = over});
    EXPECT_FALSE(motion.at(0.21));
}

TEST(SampledMotion, IsLostOverALoopThatStoodStill) {
    SampledMotion motion;
    const auto hear = [&](double from_s, double to_s, double arrival_s) {
        for (double at_s = from_s; at_s < to_s; at_s += 0.01)
            motion.take({.stamp_s = 1.0 + at_s,
                         .arrival_s = std::max(at_s, arrival_s),
                         .position_mm = {20.0 * at_s, 0.0, 0.0}});
    };
    hear(0.0, 0.2, 0.0);
    ASSERT_TRUE(motion.at(0.2));
    hear(0.2, 0.9, 0.9);  // all at once
    EXPECT_FALSE(motion.at(0.9));
    hear(0.9, 0.95, 0.0);
    ASSERT_TRUE(motion.at(0.95));
    EXPECT_GT(motion.at(0.951)->position_mm.x, 17.9) << "nothing of the time between is played";
}

TEST(SampledMotion, IsFiniteWhateverTheTimesAre) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int run = 0; run < 200; ++run) {
        SampledMotion motion;
        double now_s = 0.0;
        double stamp_s = 10.0;
        for (int i = 0; i < 1000; ++i) {
            now_s += std::pow(10.0, -5.0 * share(random));
            stamp_s += std::pow(10.0, -6.0 * share(random)) * (share(random) < 0.1 ? -1.0 : 1.0);
            motion.take({.stamp_s = share(random) < 0.02 ? 0.0 : stamp_s,
                         .arrival_s = now_s,
                         .position_mm = glm::dvec3(share(random))});
            if (share(random) < 0.7) continue;
            const auto pose = motion.at(now_s);
            if (pose) {
                EXPECT_TRUE(std::isfinite(glm::length(pose->position_mm)));
                EXPECT_TRUE(std::isfinite(glm::length(pose->velocity_mm_per_s)));
            }
        }
    }
}

}  // namespace
}  // namespace osteomill::sampled_motion_test
