#include "render_client/ui/view/shown_tool.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(ShownTool, TurnsWhileStatesComeHoweverLongAFrameTakes) {
    ShownTool tool;
    ToolState state;
    state.spindle_on = true;
    for (const double frame_s : {0.02, 0.1, 0.6, 2.0}) {
        tool.take(state);
        tool.turn(frame_s, nullptr);
        EXPECT_EQ(tool.drawn(state, nullptr, std::nullopt).motion, BurrMotion::at_speed) << frame_s;
    }
    tool.turn(0.3, nullptr);
    EXPECT_EQ(tool.drawn(state, nullptr, std::nullopt).motion, BurrMotion::still) << "nothing was heard";
}

}  // namespace
}  // namespace osteomill
