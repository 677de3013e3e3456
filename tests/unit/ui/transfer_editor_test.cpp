#include "render_client/ui/panels/transfer_editor.h"

#include <gtest/gtest.h>

namespace osteomill::transfer_editor_test {
namespace {

TransferFunction ramp() {
    return {"ramp", TransferMode::surface, {{0.5, {0, 0, 0}, 0.0}, {1.5, {255, 255, 255}, 1.0}}};
}

TEST(TransferEditor, TakesHoldOfTheNearestPointWithinReach) {
    TransferEditor editor(ramp());
    editor.select_near(0.55, 0.02, 0.1, 0.1);
    EXPECT_EQ(editor.selected(), 0u);
    editor.select_near(1.4, 0.95, 0.2, 0.1);
    EXPECT_EQ(editor.selected(), 1u);
    editor.select_near(1.0, 0.5, 0.2, 0.1);
    EXPECT_EQ(editor.selected(), std::nullopt);
    EXPECT_FALSE(editor.take_change()) << "looking changes nothing";
}

TEST(TransferEditor, KeepsPointsInOrderAndInRange) {
    TransferEditor editor(ramp());
    editor.select_near(0.5, 0.0, 0.1, 0.1);
    editor.move(9.0, -3.0);
    EXPECT_LT(editor.function()->points[0].value, 1.5);
    EXPECT_EQ(editor.function()->points[0].opacity, 0.0);
    editor.move(-1.0, 7.0);
    EXPECT_EQ(editor.function()->points[0].value, 0.0);
    EXPECT_EQ(editor.function()->points[0].opacity, 1.0);
    EXPECT_NO_THROW(require_valid(*editor.function()));
    EXPECT_TRUE(editor.take_change());
    EXPECT_FALSE(editor.take_change()) << "once is enough";
}

TEST(TransferEditor, AddsAPointOnTheLineAndRemovesAllButTheLast) {
    TransferEditor editor(ramp());
    const glm::vec4 before = look_of(ramp(), 0.8);
    editor.add(1.0);
    EXPECT_EQ(editor.selected(), 1u);
    ASSERT_EQ(editor.function()->points.size(), 3u);
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_NEAR(look_of(*editor.function(), 0.8)[channel], before[channel], 0.01f);
    editor.remove();
    EXPECT_EQ(*editor.function(), ramp());
    editor.select_near(0.5, 0.0, 0.1, 0.1);
    editor.remove();
    editor.select_near(1.5, 1.0, 0.1, 0.1);
    editor.remove();
    EXPECT_EQ(editor.function()->points.size(), 1u);
}

TEST(TransferEditor, DoesNothingToOwnColours) {
    TransferEditor editor;
    editor.add(1.0);
    editor.select_near(1.0, 1.0, 1.0, 1.0);
    editor.move(1.0, 1.0);
    editor.remove();
    EXPECT_FALSE(editor.take_change());
    editor.choose(transfer_presets()[0]);
    EXPECT_TRUE(editor.take_change());
    editor.choose(std::nullopt);
    EXPECT_TRUE(editor.take_change());
}

}  // namespace
}  // namespace osteomill::transfer_editor_test
