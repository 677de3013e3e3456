#include "render_client/volume/transfer_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/scene/stiffness_relation.h"
#include "render_client/volume/bone_colours.h"
#include "tests/support/message_of.h"

namespace osteomill::transfer_function_test {
namespace {

const TransferFunction ramp{.name = "ramp", .points = {{0.5, {0, 0, 0}, 0.0}, {1.5, {255, 255, 255}, 1.0}}};

TEST(TransferFunction, RunsAlongLinesAndHoldsItsEnds) {
    EXPECT_EQ(look_of(ramp, -3.0), glm::vec4(0.0f));
    EXPECT_FLOAT_EQ(look_of(ramp, 0.75).a, 0.25f);
    EXPECT_FLOAT_EQ(look_of(ramp, 0.75).g, 0.25f);
    EXPECT_EQ(look_of(ramp, 9.0), glm::vec4(1.0f));
}

TEST(TransferFunction, RefusesWhatIsNoFunctionAndNamesThePoint) {
    const auto message = [](const TransferFunction& function) -> std::string {
        return testing::message_of<std::invalid_argument>([&] { require_valid(function); });
    };
    EXPECT_EQ(message(ramp), "");
    EXPECT_NE(message({.name = "none"}).find("'none' has no control point"), std::string::npos);
    EXPECT_NE(message({.name = "back", .points = {{1.0, {}, 1.0}, {1.0, {}, 1.0}}}).find("point 2"),
              std::string::npos);
    EXPECT_NE(message({.name = "thick", .points = {{1.0, {}, 1.5}}}).find("opacity is 1.5"),
              std::string::npos);
    EXPECT_NE(message({.name = "nan", .points = {{std::nan(""), {}, 1.0}}}).find("no number"),
              std::string::npos);
}

TEST(TransferPresets, AreValidAndDifferInWhatTheyHide) {
    ASSERT_EQ(transfer_presets().size(), 3u);
    for (const TransferFunction& preset : transfer_presets()) EXPECT_NO_THROW(require_valid(preset));
    const TransferFunction& bone = transfer_presets()[0];
    const TransferFunction& tooth = transfer_presets()[1];
    const TransferFunction& window = transfer_presets()[2];
    constexpr double trabecular = 0.1, enamel = 2.0;
    EXPECT_EQ(look_of(bone, trabecular).a, 1.0f);
    EXPECT_LT(look_of(tooth, trabecular).a, 0.2f);
    EXPECT_GT(look_of(tooth, enamel).a, 0.9f);
    EXPECT_EQ(look_of(window, trabecular).a, 1.0f);
    EXPECT_LT(look_of(window, trabecular).r, 0.25f);
    EXPECT_EQ(look_of(window, enamel), glm::vec4(1.0f));
}

TEST(TransferPresets, ShowBoneInTheColoursOfItsStiffness) {
    const ColourTable table = colours_by_stiffness(0.02);
    for (const std::size_t code : {0u, 20u, 50u, 90u, 255u}) {
        const glm::vec4 look = look_of(transfer_presets()[0], 0.02 * static_cast<double>(code));
        for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(look[channel], table[code][channel], 1e-5);
    }
}

TEST(CtWindow, IsBlackBelowAndWhiteAbove) {
    const TransferFunction window = ct_window(1000.0, 1000.0);
    EXPECT_NO_THROW(require_valid(window));
    const auto at_hu = [&](double hu) {
        return look_of(window, relative_stiffness(default_stiffness_relation(), hu));
    };
    EXPECT_NEAR(at_hu(1500.0).r, 1.0f, 1e-6);
    EXPECT_NEAR(at_hu(1000.0).r, linear_from_srgb({128, 128, 128}).r, 0.01);
    EXPECT_LT(at_hu(800.0).r, 0.1f);
    EXPECT_EQ(at_hu(700.0).a, 0.0f);
}

}  // namespace
}  // namespace osteomill::transfer_function_test
