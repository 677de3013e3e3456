#include "render_client/ui/input/hand_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace osteomill::hand_input_test {
namespace {

/// A link without a server: it reports a tool, and keeps sent messages.
class DeskSource final : public SessionSource {
  public:
    LinkUpdate poll() override { return {}; }
    const Bone* bone() const override { return nullptr; }
    const SessionInfo* session() const override { return nullptr; }
    void send_operator(const OperatorCommand& command) override { sent.push_back(command); }
    std::optional<ToolState> newest_tool() const override { return tool; }

    std::optional<ToolState> tool = ToolState{.driver = ToolDriver::nobody};
    std::vector<OperatorCommand> sent;
};

struct Desk {
    Desk() { desk.show(picture); }
    void step() {
        desk.step(input, 0.01);
        input.forget_events();
    }

    DeskSource source;
    HandInput desk{source};
    HandInputPicture picture{.drills = true, .burr_count = 3, .size_px = {640, 480}};
    WindowInput input{.is_focused = true, .size = {640.0, 480.0}, .framebuffer_size_px = {640, 480}};
};

TEST(HandInput, LeavesTheToolToOthersUntilItIsUsed) {
    Desk desk;
    desk.step();
    desk.input.cursor = {50.0, 50.0};
    desk.step();
    EXPECT_TRUE(desk.source.sent.empty());
    EXPECT_FALSE(desk.desk.is_driving());
}

TEST(HandInput, SendsAtEveryStepWhileThePedalIsDownAndOnceThatItIsUp) {
    Desk desk;
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    for (int i = 0; i < 5; ++i) desk.step();
    ASSERT_EQ(desk.source.sent.size(), 5u);
    EXPECT_TRUE(desk.source.sent.back().pedal);
    desk.input.keys_down[GLFW_KEY_SPACE] = false;
    desk.step();
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 6u);
    EXPECT_FALSE(desk.source.sent.back().pedal);
}

TEST(HandInput, SaysThatThePedalIsUpBeforeItIsDownButNotOfAKeyThatWasHeldBefore) {
    Desk desk;
    desk.step();
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    desk.step();
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 2u);
    EXPECT_FALSE(desk.source.sent.front().pedal);
    EXPECT_TRUE(desk.source.sent.back().pedal);

    desk.picture.drills = false;  // the session is lost
    desk.desk.show(desk.picture);
    desk.step();
    desk.picture.drills = true;
    desk.desk.show(desk.picture);
    desk.source.sent.clear();
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 1u);
    EXPECT_TRUE(desk.source.sent.front().pedal) << "the server keeps the spindle off";
}

TEST(HandInput, LiftsThePedalWhenTheWindowLosesTheKeyboard) {
    Desk desk;
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    desk.step();
    desk.input.is_focused = false;
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 2u);
    EXPECT_FALSE(desk.source.sent.back().pedal);
}

TEST(HandInput, DragsTheHandButNotWithAMouseThatAPanelHas) {
    Desk desk;
    desk.step();
    desk.input.is_down[WindowInput::left] = desk.input.went_down[WindowInput::left] = true;
    desk.step();
    desk.input.cursor = {20.0, 0.0};
    desk.step();
    ASSERT_TRUE(desk.desk.is_driving());
    EXPECT_GT(glm::length(desk.source.sent.back().hand_target_mm), 0.0);

    Desk other;
    other.picture.panels_have_mouse = true;
    other.desk.show(other.picture);
    other.step();
    other.input.is_down[WindowInput::left] = other.input.went_down[WindowInput::left] = true;
    other.step();
    other.input.cursor = {20.0, 0.0};
    other.step();
    EXPECT_TRUE(other.source.sent.empty());
}

TEST(HandInput, DragsABurrInAirOverTheBoneUnderThePointerAndTheWheelIsDepth) {
    Desk desk;
    desk.picture.over_bone_mm = glm::dvec3(1.0, 2.0, 3.0);
    desk.desk.show(desk.picture);
    desk.step();
    desk.input.is_down[WindowInput::left] = desk.input.went_down[WindowInput::left] = true;
    desk.step();
    EXPECT_EQ(desk.source.sent.back().hand_target_mm, glm::dvec3(1.0, 2.0, 3.0))
        << "though nothing has moved";
    // Along the spindle, which points up: the tool's.
    desk.input.wheel.y = 2.0;
    desk.step();
    EXPECT_NEAR(desk.source.sent.back().hand_target_mm.z, 2.8, 1e-9);
    desk.step();
    EXPECT_NEAR(desk.source.sent.back().hand_target_mm.z, 2.8, 1e-9) << "kept while the drag goes on";
    for (bool WindowInput::*key : {&WindowInput::ctrl, &WindowInput::alt}) {
        desk.input.*key = true;
        desk.input.wheel.y = 2.0;
        desk.step();
        desk.input.*key = false;
        EXPECT_NEAR(desk.source.sent.back().hand_target_mm.z, 2.8, 1e-9) << "zoom, cuts";
    }

    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    desk.step();
    desk.picture.over_bone_mm = glm::dvec3(9.0, 9.0, 9.0);
    desk.desk.show(desk.picture);
    desk.step();
    EXPECT_NEAR(desk.source.sent.back().hand_target_mm.z, 2.8, 1e-9) << "in bone nothing jumps";
    desk.input.cursor.x += 10.0;
    desk.step();
    EXPECT_GT(glm::distance(desk.source.sent.back().hand_target_mm, {1.0, 2.0, 2.8}), 1e-3);
    EXPECT_LT(glm::distance(desk.source.sent.back().hand_target_mm, {1.0, 2.0, 2.8}), 3.0);
}

TEST(HandInput, AsksForAToolThatAnotherHasButDoesNotHoldOnToIt) {
    Desk desk;
    desk.source.tool->driver = ToolDriver::another;
    desk.input.presses = {{GLFW_KEY_2}};
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 1u);
    EXPECT_EQ(desk.source.sent.back().burr, 1u);
    EXPECT_FALSE(desk.desk.is_driving());
}

TEST(HandInput, FallsSilentWhereThereIsNoSessionToDrillIn) {
    Desk desk;
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    desk.step();
    desk.source.tool.reset();
    desk.step();
    EXPECT_EQ(desk.source.sent.size(), 1u);
    EXPECT_FALSE(desk.desk.is_driving());
    desk.source.tool = ToolState{};
    desk.picture.drills = false;
    desk.desk.show(desk.picture);
    desk.step();
    EXPECT_EQ(desk.source.sent.size(), 1u);
    EXPECT_FALSE(desk.desk.command());
}

TEST(HandInput, MovesNoHandByAClickOnAPanelThatKnowsNothingOfThePointerYet) {
    Desk desk;
    desk.picture.panels = {{{100, 0}, {200, 40}}};
    desk.desk.show(desk.picture);
    desk.step();
    // The pointer gets there, clicks and goes in one step, before a frame was drawn.
    desk.input.cursor = {150.0, 20.0};
    desk.input.is_down[WindowInput::left] = desk.input.went_down[WindowInput::left] = true;
    desk.step();
    desk.input.cursor = {150.0, 200.0};
    desk.step();
    EXPECT_TRUE(desk.source.sent.empty());
}

TEST(HandInput, HasAPedalForWhoeverHasOnlyAMouse) {
    Desk desk;
    desk.desk.switch_pedal();
    desk.step();
    desk.step();
    ASSERT_EQ(desk.source.sent.size(), 2U);
    EXPECT_TRUE(desk.source.sent.back().pedal);
    desk.desk.switch_pedal();
    desk.step();
    EXPECT_FALSE(desk.source.sent.back().pedal);

    desk.desk.switch_pedal();
    desk.step();
    desk.step();
    EXPECT_TRUE(desk.source.sent.back().pedal);
    desk.picture.holds_still = true;
    desk.desk.show(desk.picture);
    desk.step();
    EXPECT_FALSE(desk.source.sent.back().pedal) << "a pause lifts it";
    desk.picture.holds_still = false;
    desk.desk.show(desk.picture);
    desk.step();
    EXPECT_FALSE(desk.source.sent.back().pedal) << "and it stays up";

    desk.desk.switch_pedal();
    desk.step();
    desk.input.is_focused = false;
    desk.step();
    desk.input.is_focused = true;
    desk.step();
    EXPECT_FALSE(desk.source.sent.back().pedal) << "likewise a window that was left";
}

TEST(HandInput, SendsEveryReleaseThoughTheNextPressCameBeforeTheNextStep) {
    Desk desk;
    desk.desk.switch_pedal();
    desk.step();
    desk.step();
    ASSERT_TRUE(desk.source.sent.back().pedal);
    desk.desk.switch_pedal();
    desk.desk.switch_pedal();
    desk.step();
    EXPECT_FALSE(desk.source.sent.back().pedal);
    desk.step();  // the hand had let go of the tool, and says once more that the pedal is up
    desk.step();
    EXPECT_TRUE(desk.source.sent.back().pedal);

    Desk by_key;
    by_key.input.keys_down[GLFW_KEY_SPACE] = true;
    by_key.step();
    by_key.step();
    ASSERT_TRUE(by_key.source.sent.back().pedal);
    by_key.input.presses = {{.key = GLFW_KEY_SPACE}};
    by_key.step();
    EXPECT_FALSE(by_key.source.sent.back().pedal);
    by_key.step();
    EXPECT_TRUE(by_key.source.sent.back().pedal);
}

TEST(HandInput, TiltsTheHandpieceWithoutMovingItsTip) {
    Desk desk;
    desk.picture.drag_tilts = true;
    desk.desk.show(desk.picture);
    desk.step();
    desk.input.is_down[WindowInput::left] = desk.input.went_down[WindowInput::left] = true;
    desk.step();
    desk.input.cursor = {40.0, 0.0};
    desk.step();
    const OperatorCommand& tilted = desk.source.sent.back();
    EXPECT_EQ(tilted.hand_target_mm, desk.source.tool->hand_position_mm);
    const double angle_rad = std::acos(glm::dot(tilted.spindle_axis, glm::dvec3(0.0, 0.0, 1.0)));
    EXPECT_GT(angle_rad, 0.02);
    EXPECT_NEAR(glm::length(tilted.spindle_axis), 1.0, 1e-12);
    // It stays so while the tool follows.
    desk.input.is_down[WindowInput::left] = false;
    const glm::dvec3 axis = tilted.spindle_axis;
    desk.step();
    EXPECT_EQ(desk.source.sent.back().spindle_axis, axis);
}

TEST(HandInput, TakesNoLettersForCommandsWhileATextIsWritten) {
    Desk desk;
    desk.picture.panels_have_keyboard = true;
    desk.desk.show(desk.picture);
    desk.input.keys_down[GLFW_KEY_SPACE] = desk.input.keys_down[GLFW_KEY_W] = true;
    desk.input.presses = {{GLFW_KEY_W}, {GLFW_KEY_2}};
    desk.step();
    EXPECT_TRUE(desk.source.sent.empty());
}

TEST(HandInput, LeavesToANoteWhatIsTypedBeforeThePictureShowsItsField) {
    Desk desk;
    desk.input.presses = {{GLFW_KEY_M}, {GLFW_KEY_2}, {GLFW_KEY_SPACE}};
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    for (int i = 0; i < 5; ++i) desk.step();
    desk.desk.show(desk.picture);  // a picture that knows nothing of it
    for (int i = 0; i < 5; ++i) desk.step();
    EXPECT_TRUE(desk.source.sent.empty()) << "neither pedal nor burr";
    // The field is there, and closed by the time that a key is held.
    desk.picture.panels_have_keyboard = true;
    desk.desk.show(desk.picture);
    desk.step();
    EXPECT_TRUE(desk.source.sent.empty());
    desk.input.keys_down[GLFW_KEY_SPACE] = false;
    desk.step();
    desk.picture.panels_have_keyboard = false;
    desk.desk.show(desk.picture);
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    for (int i = 0; i < 3; ++i) desk.step();
    ASSERT_FALSE(desk.source.sent.empty());
    EXPECT_TRUE(desk.source.sent.back().pedal);
}

TEST(HandInput, HasItsKeysAgainWhereNoNoteMayBeWritten) {
    Desk desk;
    desk.input.presses = {{GLFW_KEY_M}};
    desk.step();
    for (int i = 0; i < 3; ++i) desk.desk.show(desk.picture);
    desk.input.keys_down[GLFW_KEY_SPACE] = true;
    for (int i = 0; i < 3; ++i) desk.step();
    ASSERT_FALSE(desk.source.sent.empty());
    EXPECT_TRUE(desk.source.sent.back().pedal);
}

}  // namespace
}  // namespace osteomill::hand_input_test
