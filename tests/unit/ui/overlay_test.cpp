#include "render_client/ui/panels/overlay.h"

#include <imgui_internal.h>

#include "render_client/ui/view/session_picture.h"
#include "tests/unit/ui/scripted_session.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::overlay_test {
namespace {

using OverlayTest = OffscreenTest;

TEST_F(OverlayTest, LeavesTheMiddleToTheBurrInEveryWindow) {
    ScriptedSession session(1000, true);
    ImguiContext panels;
    SessionPicture picture(session, panels, {500, 400});
    picture.view().transfer.choose(transfer_presets()[0]);
    picture.take_in();
    for (const glm::ivec2 size_px : {glm::ivec2(500, 400), glm::ivec2(640, 480)})
        for (const float scale : {1.0f, 2.0f})
            for (const unsigned open : {1U, 2U, 4U, 7U}) {
                picture.resize(size_px);
                picture.view().scale = scale;
                picture.view().cuts_panel_shown = (open & 1U) != 0;
                picture.view().transfer_panel_shown = (open & 2U) != 0;
                picture.view().slices_shown = (open & 4U) != 0;
                picture.draw(1.0 / 30.0);
                picture.draw(1.0 / 30.0);  // Dear ImGui knows its windows from the last frame
                EXPECT_FALSE(panels.input_boxes().empty());
                for (const PixelBox& box : panels.input_boxes()) {
                    const glm::dvec2 first(box.first), end(box.first + box.size), size(size_px);
                    const bool covers_middle = first.x < 0.6 * size.x && first.y < 0.6 * size.y &&
                                               end.x > 0.4 * size.x && end.y > 0.4 * size.y;
                    EXPECT_FALSE(covers_middle) << size_px.x << " x " << size_px.y << ", " << scale << ": at "
                                                << box.first.x << ", " << box.first.y;
                }
            }
}

TEST_F(OverlayTest, ShowsTheSlicesWholeInASmallWindow) {
    ScriptedSession session(1000, true);
    ImguiContext panels;
    for (const glm::ivec2 size_px : {glm::ivec2(800, 600), glm::ivec2(1280, 800)}) {
        SessionPicture picture(session, panels, size_px);
        picture.view().slices_shown = true;
        picture.offer_controls();
        picture.take_in();
        picture.draw(1.0 / 30.0);
        picture.draw(1.0 / 30.0);
        const ImGuiWindow* const slices = ImGui::FindWindowByName("slices");
        ASSERT_NE(slices, nullptr) << size_px.x;
        EXPECT_TRUE((slices->Flags & ImGuiWindowFlags_NoScrollbar) != 0) << size_px.x;
    }
}

}  // namespace
}  // namespace osteomill::overlay_test
