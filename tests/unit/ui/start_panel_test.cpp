#include "render_client/ui/panels/start_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "render_client/ui/panels/imgui_input.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::start_panel_test {
namespace {

/// The page of the built-in cases, in frames that are not shown.
class StartPanelTest : public OffscreenTest {
  protected:
    StartPanelTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        prepare_imgui_input(io);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~StartPanelTest() override { ImGui::DestroyContext(); }

    void keep_sessions(int count) {
        for (int i = 0; i < count; ++i) {
            const auto folder =
                folder_ / "home/reports" / ("jaw-anna-202611" + std::to_string(10 + i) + "-120000");
            std::filesystem::create_directories(folder);
            std::ofstream(folder / "session.pcap") << "recorded";
        }
        page_.show(StartPage::View::cases);
    }
    void frame(const glm::vec2& size) {
        ImGui::GetIO().DisplaySize = {size.x, size.y};
        ImGui::NewFrame();
        const glm::vec2 panel = start_panel_size(page_, size - 24.0f);
        draw_start_panel(page_, picture_, {{12.0f, 12.0f}, panel, 0}, view_, &requests_);
        ImGui::EndFrame();
    }
    /// The height of the list of sessions, in rows.
    float rows_of_sessions() const {
        for (const ImGuiWindow* window : GImGui->Windows)
            if (std::string(window->Name).find("/sessions_") != std::string::npos)
                return window->Size.y / ImGui::GetFrameHeightWithSpacing();
        return 0.0f;
    }

    static ImGuiID hide_button() { return ImGui::FindWindowByName("start")->GetID("Hide this"); }

    testing::TemporaryFolder folder_;
    StartPage page_{{folder_.path(), folder_ / "home", {"127.0.0.1", 7010}}};
    StartPicture picture_;
    ViewSettings view_;
    SessionRequests requests_;
};

TEST_F(StartPanelTest, GivesTheSessionsTheRoomThatTheCardsLeave) {
    keep_sessions(12);
    for (int i = 0; i < 3; ++i) frame({1280.0f, 800.0f});
    EXPECT_GT(rows_of_sessions(), 7.0f);
    for (int i = 0; i < 3; ++i) frame({800.0f, 600.0f});
    EXPECT_GT(rows_of_sessions(), 3.0f);
    EXPECT_LT(rows_of_sessions(), 7.0f) << "the cards are seen, too";
}

TEST_F(StartPanelTest, KeepsAllOfAPageInASmallWindow) {
    keep_sessions(12);
    for (int i = 0; i < 3; ++i) frame({800.0f, 600.0f});
    const ImGuiWindow* const page = ImGui::FindWindowByName("start");
    EXPECT_LE(page->ContentSize.y, page->InnerRect.GetHeight());
}

TEST_F(StartPanelTest, AsksBeforeItEndsTheProgramAndStartsNothingMeanwhile) {
    view_.question = SessionQuestion::end;
    frame({800.0f, 600.0f});
    frame({800.0f, 600.0f});
    EXPECT_FALSE(requests_.ends_program);
    ImguiInput().feed({.is_focused = true, .size = {800.0, 600.0}, .presses = {{GLFW_KEY_ENTER}}},
                      ImGui::GetIO());
    frame({800.0f, 600.0f});
    EXPECT_TRUE(requests_.ends_program);
    EXPECT_EQ(view_.question, SessionQuestion::none);
    EXPECT_FALSE(page_.is_session_running());
    EXPECT_EQ(page_.message(), "") << "no case was begun";
}

TEST_F(StartPanelTest, KeepsTheKeyboardInThePathUntilItIsRight) {
    const glm::vec2 size(800.0f, 600.0f);
    page_.show(StartPage::View::scan_browser);
    page_.browse(folder_.path());
    frame(size);
    frame(size);
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 first = ImGui::FindWindowByName("start")->DC.CursorStartPos;
    io.MousePos = {first.x + 200.0f, first.y + 1.5f * ImGui::GetFrameHeightWithSpacing()};
    io.MouseDown[0] = true;
    frame(size);
    io.MouseDown[0] = false;
    frame(size);
    ASSERT_TRUE(io.WantTextInput);
    const auto write = [&](const char* text) {
        io.AddInputCharactersUTF8(text);
        frame(size);
    };
    write("x");
    ImguiInput().feed({.is_focused = true, .size = {800.0, 600.0}, .presses = {{GLFW_KEY_ENTER}}}, io);
    frame(size);
    EXPECT_NE(page_.message(), "");
    for (int i = 0; i < 3; ++i) frame(size);
    EXPECT_TRUE(io.WantTextInput) << "and goes on to be written";
}

TEST_F(StartPanelTest, CannotBeHiddenWhileASessionBegins) {
    const auto program = folder_ / "haptic_server";
    std::ofstream(program) << "#!/bin/sh\ntrap 'exit 0' TERM\nwhile :; do sleep 0.01; done\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const auto click_everywhere = [&] {
        // The buttons are in the lowest rows.
        ImGuiIO& io = ImGui::GetIO();
        for (float y = 500.0f; y < 590.0f && !page_.is_hidden; y += 12.0f)
            for (float x = 20.0f; x < 780.0f && !page_.is_hidden; x += 20.0f) {
                io.MousePos = {x, y};
                frame({800.0f, 600.0f});
                if (GImGui->HoveredIdDisabled || ImGui::GetHoveredID() != hide_button()) continue;
                io.MouseDown[0] = true;
                frame({800.0f, 600.0f});
                io.MouseDown[0] = false;
                frame({800.0f, 600.0f});
            }
    };
    frame({800.0f, 600.0f});
    page_.start();
    ASSERT_TRUE(page_.is_beginning());
    click_everywhere();
    EXPECT_FALSE(page_.is_hidden);
    page_.break_off();
    for (int i = 0; i < 1000 && page_.is_session_running(); ++i) {
        page_.poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    click_everywhere();
    EXPECT_TRUE(page_.is_hidden) << "what was milled may be looked at";
}

TEST_F(StartPanelTest, DropsAQuestionOfASessionThatIsOver) {
    view_.question = SessionQuestion::mark;
    frame({800.0f, 600.0f});
    EXPECT_EQ(view_.question, SessionQuestion::none);
}

}  // namespace
}  // namespace osteomill::start_panel_test
