#include "common/sound/warning_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/sound/burr_sound.h"
#include "tests/support/strongest_note.h"

namespace osteomill::warning_tone_test {
namespace {

constexpr std::size_t second = BurrSound::rate_hz;
constexpr std::size_t frame = second / 30;

/// Warned of thirty times a second, on top of `under`.
std::vector<float> warned(WarningTone& tone, StructureWarning warning, std::size_t count,
                          float under = 0.0f) {
    std::vector<float> samples(count, under);
    for (std::size_t at = 0; at < count; at += frame) {
        tone.warn(warning);
        tone.add_to(std::span(samples).subspan(at, std::min(frame, count - at)));
    }
    return samples;
}

/// Spells of sound with 20 ms of silence or more between them.
int pulses(std::span<const float> samples) {
    int count = 0;
    std::size_t silent = second;
    for (const float sample : samples) {
        if (std::abs(sample) > 1e-3f) {
            if (silent > second / 50) ++count;
            silent = 0;
        } else {
            ++silent;
        }
    }
    return count;
}

TEST(WarningTone, PulsesTwiceASecondNearAStructureAndFiveTimesAtIt) {
    WarningTone near, touch, none;
    EXPECT_EQ(pulses(warned(near, StructureWarning::near, 2 * second)), 4);
    EXPECT_EQ(pulses(warned(touch, StructureWarning::touch, 2 * second)), 10);
    EXPECT_EQ(pulses(warned(none, StructureWarning::none, second)), 0);
}

TEST(WarningTone, HasItsFundamentalAndFourHarmonics) {
    WarningTone tone;
    const auto samples = warned(tone, StructureWarning::touch, second);
    const auto pulse = std::span(samples).first(second / 10);
    EXPECT_NEAR(testing::strongest_hz(pulse, BurrSound::rate_hz), 880.0, 10.0);
    for (int harmonic = 2; harmonic <= 5; ++harmonic) {
        double in_phase = 0.0, across = 0.0;
        for (std::size_t i = 0; i < pulse.size(); ++i) {
            const double turn = 2.0 * std::numbers::pi * 880.0 * harmonic * static_cast<double>(i) / second;
            in_phase += static_cast<double>(pulse[i]) * std::sin(turn);
            across += static_cast<double>(pulse[i]) * std::cos(turn);
        }
        EXPECT_GT(2.0 * std::hypot(in_phase, across) / static_cast<double>(pulse.size()), 0.02) << harmonic;
    }
}

TEST(WarningTone, BeginsAndEndsWithoutAClickAndStaysWithinTheScale) {
    WarningTone tone;
    const auto samples = warned(tone, StructureWarning::touch, second);
    float largest_step = 0.0f;
    for (std::size_t i = 1; i < samples.size(); ++i)
        largest_step = std::max(largest_step, std::abs(samples[i] - samples[i - 1]));
    // The bound is 0.3 times the steepest slope of the five sines.
    EXPECT_LT(largest_step, 0.3 * 2.0 * std::numbers::pi * 880.0 * 2.23 / second);
    EXPECT_LT(std::abs(samples.front()), 1e-3f);
    WarningTone over_loud;
    const auto loud = warned(over_loud, StructureWarning::touch, second, 0.9f);
    EXPECT_LE(*std::ranges::max_element(loud), 1.0f);
    EXPECT_GT(*std::ranges::max_element(loud), 0.95f);
}

TEST(WarningTone, EndsItsPulseAndThenIsSilentWhereNothingIsToldAnyMore) {
    WarningTone tone;
    warned(tone, StructureWarning::near, frame);
    EXPECT_FALSE(tone.is_silent());
    std::vector<float> rest(second);
    tone.add_to(rest);
    EXPECT_TRUE(tone.is_silent());
    WarningTone cleared;
    warned(cleared, StructureWarning::touch, frame);
    const auto after = warned(cleared, StructureWarning::none, second);
    EXPECT_EQ(pulses(after), 1) << "the one that had begun";
    EXPECT_TRUE(cleared.is_silent());
}

TEST(GravestWarning, IsATouchBeforeANearnessByTheTissuesOwnMeasure) {
    const std::vector<Tissue> tissues{{.label = 1, .name = "nerve", .is_protected = true, .warn_mm = 2.0},
                                      {.label = 2, .name = "sinus", .is_protected = true, .warn_mm = 1.0}};
    const auto gravest = [&](const std::vector<StructureDistance>& distances) {
        return gravest_warning(distances, tissues);
    };
    EXPECT_EQ(gravest({}), StructureWarning::none);
    EXPECT_EQ(gravest({{.tissue = 1, .distance_mm = 1.5}}), StructureWarning::none);
    EXPECT_EQ(gravest({{.tissue = 0, .distance_mm = 1.5}}), StructureWarning::near);
    EXPECT_EQ(
        gravest({{.tissue = 1, .distance_mm = 0.0, .touches = true}, {.tissue = 0, .distance_mm = 1.0}}),
        StructureWarning::touch);
    EXPECT_EQ(gravest({{.tissue = 0}}), StructureWarning::none) << "touched before, far away now";
}

}  // namespace
}  // namespace osteomill::warning_tone_test
