#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "common/sound/burr_sound.h"

namespace osteomill {
namespace {

const Burr burr{.edges = 8, .spindle_rev_per_s = 1000.0};

TEST(SoundCue, FollowsTheSpindleAndItsLoad) {
    ToolState tool{.spindle_on = true};
    EXPECT_EQ(cue_of(tool, burr).rev_per_s, 1000.0);
    EXPECT_EQ(cue_of(tool, burr).edges, 8);
    EXPECT_EQ(cue_of(tool, burr).force_n, 0.0);
    tool.spindle_rpm = 30'000.0;
    EXPECT_EQ(cue_of(tool, burr).rev_per_s, 500.0);
    tool.cut = {.force_n = 0.5, .tooth_ripple_n = 0.25, .relative_stiffness = 2.0};
    EXPECT_EQ(cue_of(tool, burr).rev_per_s, 500.0);
    EXPECT_EQ(cue_of(tool, burr).strain, 0.0);
    EXPECT_EQ(cue_of(tool, burr).force_n, 0.5);
    EXPECT_EQ(cue_of(tool, burr).tooth_ripple_n, 0.25);
    EXPECT_EQ(cue_of(tool, burr).relative_stiffness, 2.0);
    tool.cut->loaded_rpm = 7500.0;
    EXPECT_EQ(cue_of(tool, burr).rev_per_s, 125.0);
    EXPECT_EQ(cue_of(tool, burr).strain, 0.75);
    tool.cut->loaded_rpm = 0.0;
    EXPECT_EQ(cue_of(tool, burr).strain, 1.0);
}

TEST(SoundCue, OfASpindleThatStandsIsNothing) {
    const ToolState tool{.cut = CutState{.force_n = 3.0, .loaded_rpm = 10.0}};
    EXPECT_EQ(cue_of(tool, burr).rev_per_s, 0.0);
    EXPECT_EQ(cue_of(tool, burr).force_n, 0.0);
    EXPECT_EQ(cue_of(tool, burr).strain, 0.0);
}

TEST(SoundCue, OfOddNumbersStillMakesFiniteSound) {
    const std::vector<double> odd{0.0,   -1.0, 1e-300, 1e300, std::numeric_limits<double>::infinity(),
                                  -1e30, 5.0,  NAN,    -0.0,  -std::numeric_limits<double>::infinity()};
    std::mt19937 random(5);
    const auto any = [&] { return odd[random() % odd.size()]; };
    BurrSound sound;
    std::vector<float> samples(64);
    for (int i = 0; i < 2000; ++i) {
        ToolState tool{.spindle_on = true, .spindle_rpm = any()};
        tool.cut = {.force_n = any(), .tooth_ripple_n = any(), .relative_stiffness = any()};
        if (i % 2 == 0) tool.cut->loaded_rpm = any();
        const Burr odd_burr{.edges = static_cast<int>(random() % 1001), .spindle_rev_per_s = any()};
        sound.hear(cue_of(tool, odd_burr));
        sound.render(samples);
        for (const float sample : samples) ASSERT_LE(std::abs(sample), 1.0f);
    }
}

}  // namespace
}  // namespace osteomill
