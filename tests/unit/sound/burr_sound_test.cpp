#include "common/sound/burr_sound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/strongest_note.h"

namespace osteomill {
namespace {

using testing::rms;
using testing::strongest_hz;

constexpr std::size_t second = BurrSound::rate_hz;
constexpr std::size_t frame = second / 30;

const SoundCue in_air{.rev_per_s = 40'000.0 / 60.0, .edges = 6};
const SoundCue in_dentine{.rev_per_s = 40'000.0 / 60.0,
                          .edges = 6,
                          .force_n = 0.5,
                          .tooth_ripple_n = 0.3,
                          .relative_stiffness = 1.2};

/// So many samples of a tool that goes on according to the cue, which is updated thirty times a second.
std::vector<float> samples_of(BurrSound& sound, const SoundCue& cue, std::size_t count) {
    std::vector<float> samples(count);
    for (std::size_t at = 0; at < count; at += frame) {
        sound.hear(cue);
        sound.render(std::span(samples).subspan(at, std::min(frame, count - at)));
    }
    return samples;
}

/// Once it has run up.
std::vector<float> steady(const SoundCue& cue) {
    BurrSound sound;
    samples_of(sound, cue, second);
    return samples_of(sound, cue, second);
}

float largest_step(std::span<const float> samples) {
    float largest = 0.0f;
    for (std::size_t i = 1; i < samples.size(); ++i)
        largest = std::max(largest, std::abs(samples[i] - samples[i - 1]));
    return largest;
}

/// Share of a sound's power above a frequency.
double share_above(std::span<const float> samples, double hz) {
    const double pole = std::exp(-2.0 * std::numbers::pi * hz / BurrSound::rate_hz);
    std::vector<float> above;
    double low = 0.0;
    for (const float sample : samples) {
        low = pole * low + (1.0 - pole) * static_cast<double>(sample);
        above.push_back(sample - static_cast<float>(low));
    }
    return std::pow(rms(above) / rms(samples), 2.0);
}

TEST(BurrSound, OfACutHasItsPeakAtEdgesTimesRevolutions) {
    std::mt19937 random(2311);
    std::uniform_real_distribution<double> log_note(std::log(60.0), std::log(16'000.0));
    std::uniform_real_distribution<double> log_force(std::log(0.05), std::log(20.0));
    std::uniform_real_distribution<double> ripple(0.0, 2.0);
    std::uniform_real_distribution<double> log_stiffness(std::log(0.03), std::log(5.0));
    std::uniform_int_distribution<int> edges(1, 24);
    for (int i = 0; i < 40; ++i) {
        const double note_hz = std::exp(log_note(random));
        SoundCue cue{.edges = edges(random), .force_n = std::exp(log_force(random))};
        cue.rev_per_s = note_hz / cue.edges;
        if (cue.rev_per_s < 10.0) continue;
        cue.tooth_ripple_n = ripple(random) * cue.force_n;
        cue.relative_stiffness = std::exp(log_stiffness(random));
        EXPECT_NEAR(strongest_hz(steady(cue), BurrSound::rate_hz), note_hz, std::max(0.01 * note_hz, 1.0))
            << cue.edges << " edges, " << cue.force_n << " N, ripple " << cue.tooth_ripple_n << ", stiffness "
            << cue.relative_stiffness;
    }
}

TEST(BurrSound, IsSilenceWhileTheSpindleStands) {
    BurrSound sound;
    EXPECT_TRUE(sound.is_silent());
    for (const float sample : samples_of(sound, SoundCue{}, second)) EXPECT_EQ(sample, 0.0f);
    samples_of(sound, in_dentine, second);
    EXPECT_FALSE(sound.is_silent());
    samples_of(sound, SoundCue{}, 3 * second);
    EXPECT_TRUE(sound.is_silent());
    for (const float sample : samples_of(sound, SoundCue{}, second)) EXPECT_EQ(sample, 0.0f);
}

TEST(BurrSound, EndsWhereNobodyTellsOfTheToolAnyMore) {
    BurrSound sound;
    samples_of(sound, in_dentine, second);
    std::vector<float> untold(4 * second);
    sound.render(untold);
    EXPECT_GT(rms(std::span(untold).first(second / 4)), 0.01);
    EXPECT_TRUE(sound.is_silent());
    EXPECT_EQ(untold.back(), 0.0f);
}

TEST(BurrSound, IsQuietInAirAndRisesWithTheForce) {
    double before = rms(steady(in_air));
    EXPECT_GT(before, 0.005);
    for (const double force_n : {0.1, 0.3, 1.0, 3.0, 9.0}) {
        SoundCue cue = in_dentine;
        cue.force_n = force_n;
        cue.tooth_ripple_n = 0.5 * force_n;
        const double louder = rms(steady(cue));
        EXPECT_GT(louder, 1.15 * before) << force_n;
        before = louder;
    }
}

TEST(BurrSound, IsBrighterInHarderBone) {
    SoundCue cue = in_dentine;
    cue.rev_per_s = 20.0;  // its notes are all below the grain
    double before = 0.0;
    for (const double stiffness : {0.05, 0.22, 1.0, 2.5}) {
        cue.relative_stiffness = stiffness;
        const double share = share_above(steady(cue), 2000.0);
        EXPECT_GT(share, 1.2 * before) << stiffness;
        before = share;
    }
}

TEST(BurrSound, HasMoreHarmonicsWhereTheForceComesInPulses) {
    SoundCue cue = in_dentine;
    cue.rev_per_s = 100.0;
    cue.tooth_ripple_n = 0.2 * cue.force_n;
    const double smooth = share_above(steady(cue), 1500.0);
    cue.tooth_ripple_n = 1.7 * cue.force_n;
    EXPECT_GT(share_above(steady(cue), 1500.0), smooth);
}

TEST(BurrSound, DoesNotClickWhateverChanges) {
    std::mt19937 random(77);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    float steady_step = 0.0f;
    SoundCue loudest{.rev_per_s = 2000.0 / 6.0, .edges = 6, .force_n = 10.0, .tooth_ripple_n = 20.0};
    steady_step = largest_step(steady(loudest));
    BurrSound sound;
    std::vector<float> all;
    for (int i = 0; i < 300; ++i) {
        SoundCue cue;
        if (unit(random) < 0.7) cue.rev_per_s = loudest.rev_per_s * unit(random);
        if (cue.rev_per_s > 0.0 && unit(random) < 0.7) {
            cue.force_n = 10.0 * unit(random);
            cue.tooth_ripple_n = 2.0 * cue.force_n * unit(random);
            cue.relative_stiffness = 0.02 + 0.98 * unit(random);
        }
        const std::vector<float> next = samples_of(sound, cue, frame);
        all.insert(all.end(), next.begin(), next.end());
    }
    EXPECT_LT(largest_step(all), 1.2f * steady_step);
    EXPECT_GT(rms(all), 0.01);
    // A cue that changes does not show in the very next sample.
    BurrSound changed;
    std::vector<float> before = samples_of(changed, in_dentine, second);
    BurrSound unchanged = changed;
    SoundCue heavier = in_dentine;
    heavier.force_n = 10.0;
    heavier.tooth_ripple_n = 15.0;
    const float next = samples_of(unchanged, in_dentine, 1).front();
    EXPECT_NEAR(samples_of(changed, heavier, 1).front(), next, 0.002);
}

TEST(BurrSound, RepeatsToTheBit) {
    const auto play = [] {
        BurrSound sound;
        std::vector<float> all;
        for (const SoundCue& cue : {in_air, in_dentine, SoundCue{}, in_air}) {
            const std::vector<float> next = samples_of(sound, cue, second);
            all.insert(all.end(), next.begin(), next.end());
        }
        return all;
    };
    EXPECT_EQ(play(), play());
    // And in pieces of any length.
    BurrSound sound;
    BurrSound in_pieces;
    sound.hear(in_dentine);
    in_pieces.hear(in_dentine);
    std::vector<float> whole(1000);
    std::vector<float> pieces(1000);
    sound.render(whole);
    for (std::size_t at = 0; at < 1000; at += 8) in_pieces.render(std::span(pieces).subspan(at, 8));
    EXPECT_EQ(whole, pieces);
}

TEST(BurrSound, RunsUpAndCoasts) {
    BurrSound sound;
    const std::size_t part = second / 16;
    const double first_hz = strongest_hz(samples_of(sound, in_dentine, part), BurrSound::rate_hz);
    samples_of(sound, in_dentine, second);
    EXPECT_LT(first_hz, 3200.0);
    EXPECT_NEAR(strongest_hz(samples_of(sound, in_dentine, second), BurrSound::rate_hz), 4000.0, 40.0);
    samples_of(sound, SoundCue{}, second / 8);
    const std::vector<float> coasting = samples_of(sound, SoundCue{}, part);
    EXPECT_GT(rms(coasting), 0.0005);
    EXPECT_LT(strongest_hz(coasting, BurrSound::rate_hz), 3200.0);
}

TEST(BurrSound, OfAStallIsTheGrowlOfTheMotor) {
    SoundCue stalled = in_dentine;
    stalled.rev_per_s = 0.0;
    stalled.strain = 1.0;
    BurrSound sound;
    samples_of(sound, in_dentine, second);
    samples_of(sound, stalled, 2 * second);
    const std::vector<float> growl = samples_of(sound, stalled, second);
    EXPECT_GT(rms(growl), 0.02);
    EXPECT_NEAR(strongest_hz(growl, BurrSound::rate_hz), 100.0, 2.0);
    EXPECT_FALSE(sound.is_silent());
    samples_of(sound, SoundCue{}, 3 * second);
    EXPECT_TRUE(sound.is_silent());
}

TEST(BurrSound, LeavesOutWhatNobodyCanHear) {
    SoundCue cue = in_dentine;
    cue.rev_per_s = 8333.0;
    cue.edges = 64;  // 533 kHz
    const std::vector<float> samples = steady(cue);
    EXPECT_LT(strongest_hz(samples, BurrSound::rate_hz), 20'000.0);
    for (const float sample : samples) ASSERT_LE(std::abs(sample), 1.0f);
}

}  // namespace
}  // namespace osteomill
