#include "render_client/ui/panels/card_view.h"

#include <gtest/gtest.h>

#include "render_client/ui/panels/page_widgets.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::card_view_test {
namespace {

/// The built-in cases, without anything to draw on.
class CaseCardTest : public ::testing::Test {
  protected:
    CaseCardTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800.0f, 600.0f};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        ImGui::NewFrame();
    }
    ~CaseCardTest() override {
        ImGui::EndFrame();
        ImGui::DestroyContext();
    }
    float letters(float width_letters) const {
        const float letter = ImGui::GetFontSize();
        return case_card_height(page_, width_letters * letter) / letter;
    }

    testing::TemporaryFolder folder_;
    StartPage page_{{folder_.path(), folder_ / "home", {"127.0.0.1", 7010}}};
};

TEST_F(CaseCardTest, LeavesRoomBelowForAMessageOfSeveralLines) {
    EXPECT_EQ(more_message_lines(page_), 0.0f);
    page_.go_to("/" + std::string(20, 'x'));
    EXPECT_EQ(more_message_lines(page_), 0.0f) << "one line is always there";
    page_.go_to("/" + std::string(200, 'x'));
    EXPECT_GT(more_message_lines(page_), 0.5f);
}

TEST_F(CaseCardTest, IsAsHighAsTheLongestTextNeeds) {
    EXPECT_FLOAT_EQ(letters(60.0f), 7.6f) << "the picture's height";
    EXPECT_GT(letters(20.0f), letters(60.0f));
    EXPECT_FLOAT_EQ(letters(14.0f), 12.0f) << "a card is no page";
}

}  // namespace
}  // namespace osteomill::card_view_test
