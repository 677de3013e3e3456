#include "render_client/ui/panels/help_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>

#include "common/words/translation.h"

namespace osteomill::help_panel_test {
namespace {

constexpr float margin_px = 12.0f;

/// Dear ImGui without anything to draw on, in a frame.
class HelpPanel : public ::testing::Test {
  protected:
    HelpPanel() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800.0f, 600.0f};
        if (std::filesystem::exists(font_file))
            io.Fonts->AddFontFromFileTTF(font_file, letter_px, nullptr, io.Fonts->GetGlyphRangesDefault());
        unsigned char* pixels = nullptr;
        io.Fonts->GetTexDataAsRGBA32(&pixels, nullptr, nullptr);
        io.DeltaTime = 1.0f / 60.0f;
        ImGui::NewFrame();
    }
    ~HelpPanel() override {
        ImGui::EndFrame();
        ImGui::DestroyContext();
        speak("en");
    }
};

TEST_F(HelpPanel, CanBeReadInASmallWindow) {
    if (!std::filesystem::exists(font_file)) GTEST_SKIP() << font_file << " is missing (fonts-dejavu-core)";
    const PanelPainter painter(theme_of(ThemeName::dark), 1.0f);
    const glm::vec2 room(800.0f - 2.0f * margin_px, 600.0f - 2.0f * margin_px);
    for (const char* language : {"en", "de"}) {
        speak(language);
        for (const Situation situation :
             {Situation::drilling, Situation::playing, Situation::looking_on, Situation::starting}) {
            const HelpLayout help = lay_out_help(painter, situation, room);
            EXPECT_GE(letter_px * help.letters, 12.0f)
                << language << ", situation " << static_cast<int>(situation);
            EXPECT_LE(help.size.x, room.x + 1.0f);
            EXPECT_LE(help.size.y, room.y + 1.0f);
        }
    }
}

TEST_F(HelpPanel, HasOneColumnWhereThereIsRoom) {
    const PanelPainter painter(theme_of(ThemeName::dark), 1.0f);
    const HelpLayout tall = lay_out_help(painter, Situation::drilling, {4000.0f, 4000.0f});
    EXPECT_GT(tall.size.y, tall.size.x);
    EXPECT_EQ(tall.letters, 1.0f);
}

}  // namespace
}  // namespace osteomill::help_panel_test
