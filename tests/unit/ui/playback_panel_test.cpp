#include "render_client/ui/panels/playback_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::playback_panel_test {
namespace {

/// Dear ImGui without anything to draw on.
class PlaybackPanel : public ::testing::Test {
  protected:
    PlaybackPanel() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {static_cast<float>(size_px_.x), static_cast<float>(size_px_.y)};
        unsigned char* pixels = nullptr;
        io.Fonts->GetTexDataAsRGBA32(&pixels, nullptr, nullptr);
        for (int i = 0; i < 3; ++i) draw();  // a panel fits itself to what it holds
    }
    ~PlaybackPanel() override { ImGui::DestroyContext(); }

    void draw() {
        ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
        ImGui::NewFrame();
        const PanelPainter painter(theme_of(ThemeName::dark), 1.0f);
        const glm::vec2 size = playback_panel_size(painter, glm::vec2(size_px_));
        draw_playback_panel(player_, painter,
                            {{12.0f, static_cast<float>(size_px_.y) - 12.0f - size.y}, size});
        ImGui::Render();
    }
    /// Presses and lets go of the left button at a part of the picture's width, in the panel's row.
    void click(double part_of_width) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {static_cast<float>(part_of_width * size_px_.x), static_cast<float>(size_px_.y - 30)};
        draw();
        EXPECT_TRUE(io.WantCaptureMouse) << "the view must not turn meanwhile";
        io.MouseDown[0] = true;
        draw();
        io.MouseDown[0] = false;
        draw();
    }

    testing::TemporaryFolder folder_;
    testing::MadeRecording made_ =
        testing::make_recording(folder_ / "a.pcap", {.states = 100, .events = [](int i) {
                                                         std::vector<ControlEvent> marks;
                                                         if (i == 40)
                                                             marks.push_back({.action = SessionAction::mark});
                                                         return marks;
                                                     }});
    RecordingPlayer player_{folder_ / "a.pcap"};
    const glm::ivec2 size_px_{1000, 700};
};

TEST_F(PlaybackPanel, PausesAndPlays) {
    click(0.04);
    EXPECT_FALSE(player_.is_playing());
    click(0.04);
    EXPECT_TRUE(player_.is_playing());
}

TEST_F(PlaybackPanel, GoesToAnyTimeInBothDirections) {
    click(0.4);
    const double late_s = player_.time_s();
    click(0.2);
    const double early_s = player_.time_s();
    EXPECT_GT(early_s, 0.1 * player_.duration_s());
    EXPECT_GT(late_s, early_s + 0.3 * player_.duration_s());
    EXPECT_LT(late_s, player_.duration_s());
}

TEST_F(PlaybackPanel, HasATickWhereAClickGoesToTheMark) {
    draw();
    const ImU32 colour = colour_of(theme_of(ThemeName::dark)[Tone::good]);
    double sum_px = 0.0;
    int corners = 0;
    const ImDrawData& drawn = *ImGui::GetDrawData();
    for (int list = 0; list < drawn.CmdListsCount; ++list)
        for (const ImDrawVert& vertex : drawn.CmdLists[list]->VtxBuffer)
            if (vertex.col == colour) sum_px += vertex.pos.x, ++corners;
    ASSERT_GT(corners, 0);
    click(sum_px / corners / size_px_.x);
    EXPECT_NEAR(player_.time_s(), 2.0, 0.02) << "a pixel is 0.015 s";
}

TEST_F(PlaybackPanel, ChangesTheSpeed) {
    click(0.57);
    EXPECT_GT(player_.speed(), 1.0);
}

}  // namespace
}  // namespace osteomill::playback_panel_test
