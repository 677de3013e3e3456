#include "render_client/ui/panels/start_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <filesystem>
#include <fstream>
#include <string>

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

TEST_F(StartPanelTest, DropsAQuestionOfASessionThatIsOver) {
    view_.question = SessionQuestion::mark;
    frame({800.0f, 600.0f});
    EXPECT_EQ(view_.question, SessionQuestion::none);
}

}  // namespace
}  // namespace osteomill::start_panel_test
