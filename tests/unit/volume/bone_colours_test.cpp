#include "render_client/volume/bone_colours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::bone_colours_test {
namespace {

TEST(BoneColours, TurnsSrgbIntoLinearLightAsTheStandardSays) {
    EXPECT_FLOAT_EQ(linear_from_srgb({0, 0, 0}).r, 0.0f);
    EXPECT_FLOAT_EQ(linear_from_srgb({255, 0, 0}).r, 1.0f);
    EXPECT_NEAR(linear_from_srgb({128, 0, 0}).r, 0.2158605, 1e-6);
    EXPECT_NEAR(linear_from_srgb({8, 0, 0}).r, 8.0 / 255.0 / 12.92, 1e-6);
}

TEST(BoneColours, GivesATissueItsColourAndOthersPlainBone) {
    const std::array<TissueColour, 1> tissues{{{7, {10, 200, 30}}}};
    const ColourTable table = colours_by_tissue(tissues);
    EXPECT_EQ(table[7], linear_from_srgb({10, 200, 30}));
    EXPECT_EQ(table[8], plain_bone_colour());
}

TEST(BoneColours, GrowLighterWithStiffnessAndStayWithinTheTable) {
    const ColourTable table = colours_by_stiffness(0.02);
    for (std::size_t code = 1; code < table.size(); ++code)
        EXPECT_GE(table[code].g, table[code - 1].g) << "code " << code;
    EXPECT_EQ(table[255], linear_from_srgb(stiffness_colours().back().srgb));
}

}  // namespace
}  // namespace osteomill::bone_colours_test
