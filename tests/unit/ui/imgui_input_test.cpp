#include "render_client/ui/panels/imgui_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace osteomill::imgui_input_test {
namespace {

/// A page of one text and one button, without anything to draw on.
class PanelInputTest : public ::testing::Test {
  protected:
    PanelInputTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {400.0f, 300.0f};
        unsigned char* pixels = nullptr;
        io.Fonts->GetTexDataAsRGBA32(&pixels, nullptr, nullptr);
        prepare_imgui_input(io);
        input_.size = {400.0, 300.0};
        input_.framebuffer_size_px = {400, 300};
        for (int i = 0; i < 3; ++i) draw();
    }
    ~PanelInputTest() override { ImGui::DestroyContext(); }

    void draw() {
        is_waiting_ = imgui_input_.feed(input_, ImGui::GetIO(), holds_text_);
        input_.forget_events();
        ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0.0f, 0.0f});
        ImGui::SetNextWindowSize({400.0f, 300.0f});
        ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::InputText("text", text_.data(), text_.size());
        text_at_ = ImGui::GetItemRectMin();
        if (ImGui::Button("button")) ++presses_;
        button_at_ = ImGui::GetItemRectMin();
        ImGui::End();
        ImGui::Render();
    }

    /// A key that is down and up again between two frames.
    void strike(int key) {
        input_.presses.push_back({.key = key, .ctrl = input_.ctrl});
        for (int i = 0; i < 3; ++i) draw();
    }
    void click(ImVec2 at) {
        input_.has_cursor = true;
        input_.cursor = {at.x + 4.0, at.y + 4.0};
        draw();
        input_.went_down[WindowInput::left] = true;
        for (int i = 0; i < 3; ++i) draw();
    }
    std::string text() const { return text_.data(); }

    WindowInput input_;
    ImguiInput imgui_input_;
    bool is_waiting_ = false;
    bool holds_text_ = false;
    std::array<char, 32> text_{};
    ImVec2 text_at_{}, button_at_{};
    int presses_ = 0;
};

TEST_F(PanelInputTest, ClickShorterThanAFramePresses) {
    click(button_at_);
    EXPECT_EQ(presses_, 1);
}

TEST_F(PanelInputTest, ClickCountsWhereItWasThoughThePointerIsElsewhereBeforeTheFrame) {
    input_.has_cursor = true;
    input_.cursor = {300.0, 250.0};
    const glm::dvec2 on_button(button_at_.x + 4.0, button_at_.y + 4.0);
    input_.went_down[WindowInput::left] = true;
    input_.pressed_at[WindowInput::left] = input_.released_at[WindowInput::left] = on_button;
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(presses_, 1);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 300.0f);

    // It is held for more than a frame, and let go before the pointer moves on.
    input_.went_down[WindowInput::left] = input_.is_down[WindowInput::left] = true;
    input_.pressed_at[WindowInput::left] = on_button;
    draw();
    input_.is_down[WindowInput::left] = false;
    input_.released_at[WindowInput::left] = on_button;
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(presses_, 2);
}

TEST_F(PanelInputTest, ClickInEveryFrameIsAClickEach) {
    click(button_at_);
    for (int i = 0; i < 3; ++i) {
        input_.went_down[WindowInput::left] = true;
        draw();
    }
    for (int i = 0; i < 6; ++i) draw();
    EXPECT_EQ(presses_, 4);
}

TEST_F(PanelInputTest, KeysOfOneSlowFrameAreAllPressed) {
    click(text_at_);
    input_.typed = {U'a', U'b', U'c'};
    draw();
    input_.presses = {{GLFW_KEY_BACKSPACE}, {GLFW_KEY_BACKSPACE}};
    draw();
    input_.presses = {{GLFW_KEY_BACKSPACE}};
    for (int i = 0; i < 6; ++i) draw();
    EXPECT_EQ(text(), "");
}

TEST_F(PanelInputTest, CommandsOfOneSlowFrameComeInTheirOrderThoughCtrlIsUpAgain) {
    click(text_at_);
    input_.typed = {U'a', U'b'};
    draw();
    std::string copied;
    Clipboard clipboard(
        [&] { clipboard.serve([&](const std::string& text) { copied = text; }, [] { return "cd"; }); });
    give_clipboard(clipboard, ImGui::GetIO());
    input_.presses = {{.key = GLFW_KEY_A, .ctrl = true},
                      {.key = GLFW_KEY_X, .ctrl = true},
                      {.key = GLFW_KEY_V, .ctrl = true},
                      {.key = GLFW_KEY_V, .ctrl = true},
                      {.key = GLFW_KEY_BACKSPACE}};
    int frames = 0;
    do draw();
    while (is_waiting_ && ++frames < 20);
    EXPECT_EQ(copied, "ab");
    EXPECT_EQ(text(), "cdc");
}

TEST_F(PanelInputTest, TextOfOneSlowFrameComesAfterTheClickAndTheKeysBeforeIt) {
    input_.has_cursor = true;
    input_.cursor = {text_at_.x + 4.0, text_at_.y + 4.0};
    input_.went_down[WindowInput::left] = true;
    input_.typed = {{U'a', 0, true}, {U'b', 0, true}};
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(text(), "ab");

    // All is replaced by "c", and "d" comes in place of that.
    input_.presses = {{.key = GLFW_KEY_LEFT_CONTROL},
                      {.key = GLFW_KEY_A, .ctrl = true},
                      {.key = GLFW_KEY_C},
                      {.key = GLFW_KEY_BACKSPACE},
                      {.key = GLFW_KEY_D}};
    input_.typed = {{U'c', 3}, {U'd', 5}};
    for (int i = 0; i < 6; ++i) draw();
    EXPECT_EQ(text(), "d");
    EXPECT_FALSE(is_waiting_);
}

TEST_F(PanelInputTest, TextBehindTheKeyThatOpensItsFieldWaitsForTheField) {
    // M opens it, "hi" is typed and edited to "ho", RETURN ends it, in one slow frame.
    input_.presses = {{GLFW_KEY_M},         {GLFW_KEY_H}, {GLFW_KEY_I},
                      {GLFW_KEY_BACKSPACE}, {GLFW_KEY_O}, {GLFW_KEY_ENTER}};
    input_.typed = {{U'm', 1}, {U'h', 2}, {U'i', 3}, {U'o', 5}};
    WindowInput of_field = input_.take_after(1);
    EXPECT_EQ(input_.pressed_keys(), std::vector{GLFW_KEY_M});
    ASSERT_EQ(input_.typed.size(), 1U) << "its own character";
    EXPECT_EQ(of_field.presses.size(), 5U);
    draw();
    input_.append(of_field);
    holds_text_ = true;
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_TRUE(is_waiting_);
    EXPECT_EQ(presses_, 0);
    click(text_at_);
    EXPECT_EQ(text(), "");
    holds_text_ = false;
    for (int i = 0; i < 8; ++i) draw();
    EXPECT_EQ(text(), "ho");
    EXPECT_FALSE(is_waiting_);
    EXPECT_FALSE(ImGui::GetIO().WantTextInput) << "RETURN came last";
}

TEST_F(PanelInputTest, LaterInputComesAfterTheInputThatNoFrameHasTaken) {
    WindowInput before;
    before.went_down[WindowInput::left] = true;
    before.presses = {{GLFW_KEY_HOME}};
    WindowInput later;
    later.presses = {{GLFW_KEY_E}};
    later.typed = {{U'e', 1}};
    before.append(later);
    ASSERT_EQ(before.typed.size(), 1U);
    EXPECT_EQ(before.typed.front().after_presses, 2U);
    EXPECT_TRUE(before.typed.front().after_click);
}

TEST_F(PanelInputTest, AKeyThatIsHeldIsPressedOnce) {
    click(button_at_);
    input_.cursor = {300.0, 250.0};
    strike(GLFW_KEY_DOWN);  // shows the focus
    input_.presses = {{GLFW_KEY_SPACE}};
    input_.keys_down.set(GLFW_KEY_SPACE);
    for (int i = 0; i < 6; ++i) draw();
    input_.keys_down.reset(GLFW_KEY_SPACE);
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(presses_, 2) << "the click, the key";
}

TEST_F(PanelInputTest, KeysEditATextThatWasClicked) {
    click(text_at_);
    input_.typed = {U'a', U'\u00fc', U'c'};
    draw();
    EXPECT_EQ(text(), "a\u00fcc");
    strike(GLFW_KEY_BACKSPACE);
    EXPECT_EQ(text(), "a\u00fc");
    strike(GLFW_KEY_HOME);
    strike(GLFW_KEY_DELETE);
    EXPECT_EQ(text(), "\u00fc");
}

TEST_F(PanelInputTest, CtrlWithALetterIsACommandOfTheText) {
    click(text_at_);
    input_.typed = {U'a', U'b'};
    draw();
    input_.ctrl = true;
    strike(GLFW_KEY_A);
    input_.ctrl = false;
    strike(GLFW_KEY_BACKSPACE);
    EXPECT_EQ(text(), "");
}

TEST_F(PanelInputTest, CtrlWithCXAndVGoesByWayOfTheClipboard) {
    std::string desktop = "theirs";
    Clipboard clipboard([&] {
        clipboard.serve([&](const std::string& copied) { desktop = copied; }, [&] { return desktop; });
    });
    give_clipboard(clipboard, ImGui::GetIO());
    click(text_at_);
    const auto strike_with_ctrl = [&](int key) {
        input_.ctrl = true;
        strike(key);
        input_.ctrl = false;
        draw();
    };
    strike_with_ctrl(GLFW_KEY_V);
    EXPECT_EQ(text(), "theirs");
    input_.typed = {U'2'};
    draw();
    strike_with_ctrl(GLFW_KEY_A);
    strike_with_ctrl(GLFW_KEY_C);
    EXPECT_EQ(desktop, "theirs2");
    desktop = "";
    strike_with_ctrl(GLFW_KEY_X);
    EXPECT_EQ(desktop, "theirs2");
    EXPECT_EQ(text(), "");
}

TEST_F(PanelInputTest, EnterAndSpacePressWhatHasTheFocus) {
    click(button_at_);  // which gets the focus
    input_.cursor = {300.0, 250.0};
    strike(GLFW_KEY_DOWN);  // shows the focus
    const int before = presses_;
    strike(GLFW_KEY_ENTER);
    EXPECT_EQ(presses_, before + 1);
    strike(GLFW_KEY_SPACE);
    EXPECT_EQ(presses_, before + 2);
}

TEST_F(PanelInputTest, CursorOutsideOfTheWindowIsNowhere) {
    click(button_at_);
    input_.has_cursor = false;
    draw();
    EXPECT_FALSE(ImGui::IsMousePosValid());
}

}  // namespace
}  // namespace osteomill::imgui_input_test
