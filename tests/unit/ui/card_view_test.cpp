#include "render_client/ui/panels/card_view.h"

#include <gtest/gtest.h>

#include "render_client/ui/panels/start_panel.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::card_view_test {
namespace {

/// The built-in cases, in frames that are not shown.
class CaseCardTest : public OffscreenTest {
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

    struct Seen {
        float above, below;  // the chosen card's distances from the list's edges
    };
    /// A list lower than the cards, as in a window of 800 x 600.
    Seen frame() {
        ImGui::EndFrame();
        ImGui::NewFrame();
        constexpr float width = 300.0f, height = 200.0f;
        Seen seen{};
        ImGui::SetNextWindowPos({0.0f, 0.0f});
        ImGui::SetNextWindowSize({400.0f, 300.0f});
        ImGui::Begin("page");
        ImGui::BeginChild("cases", {width + 40.0f, height});
        for (std::size_t i = 0; i < page_.cases().size(); ++i) {
            draw_case_card(page_, pictures_, i, {width, case_card_height(page_, width)});
            if (i != page_.chosen) continue;
            seen.above = ImGui::GetItemRectMin().y - ImGui::GetWindowPos().y;
            seen.below = ImGui::GetWindowPos().y + height - ImGui::GetItemRectMax().y;
        }
        ImGui::EndChild();
        ImGui::End();
        return seen;
    }

    testing::TemporaryFolder folder_;
    CardPictures pictures_;
    StartPage page_{{folder_.path(), folder_ / "home", {"127.0.0.1", 7010}}};
};

TEST_F(CaseCardTest, LeavesRoomForAMessageOfSeveralLines) {
    const float line = ImGui::GetTextLineHeight();
    EXPECT_EQ(message_height(page_), line) << "one line is always there";
    page_.go_to("/" + std::string(20, 'x'));
    EXPECT_EQ(message_height(page_), line);
    page_.go_to("/" + std::string(200, 'x'));
    EXPECT_GT(message_height(page_), 1.5f * line);
}

TEST_F(CaseCardTest, IsAsHighAsTheLongestTextNeeds) {
    EXPECT_FLOAT_EQ(letters(60.0f), 7.6f) << "the picture's height";
    EXPECT_GT(letters(20.0f), letters(60.0f));
    EXPECT_FLOAT_EQ(letters(14.0f), 12.0f) << "a card is no page";
}

TEST_F(CaseCardTest, OfAnImportedCaseIsScrolledToOnce) {
    page_.chosen = page_.cases().size() - 1;
    for (int i = 0; i < 3; ++i) frame();
    EXPECT_LT(frame().below, 0.0f);
    page_.scrolls_to_chosen = true;
    frame();
    const Seen seen = frame();
    const float between = ImGui::GetStyle().ItemSpacing.y;  // which a card's area covers, too
    EXPECT_GE(seen.above, -between);
    EXPECT_GE(seen.below, -between);
    page_.chosen = 0;
    frame();
    EXPECT_LT(frame().above, 0.0f) << "a list that a person scrolls stays where it is";
}

}  // namespace
}  // namespace osteomill::card_view_test
