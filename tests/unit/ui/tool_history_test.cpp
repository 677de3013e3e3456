#include <gtest/gtest.h>

#include "render_client/ui/panels/live_plot.h"

namespace osteomill::tool_history_test {
namespace {

ToolState at_time(double time_s) {
    ToolState tool;
    tool.time_s = time_s;
    return tool;
}

TEST(ToolHistory, KeepsTheLastSecondsAndNoFrameTwice) {
    ToolHistory history;
    for (double time_s = 0.0; time_s <= 30.0; time_s += 0.5) {
        history.add(at_time(time_s));
        history.add(at_time(time_s));
    }
    EXPECT_EQ(history.samples().size(), 21u);
    EXPECT_EQ(history.samples().front().time_s, 20.0);
}

TEST(ToolHistory, KeepsWhatThePlotsShow) {
    ToolHistory history;
    history.add(ToolState{.time_s = 1.0, .force_n = {1, 2, 3}, .removed_mm3 = 4.0, .depth_mm = 0.5});
    history.add(at_time(1.1));
    EXPECT_EQ(history.samples().front().force_n, glm::dvec3(1, 2, 3));
    EXPECT_EQ(history.samples().front().removed_mm3, 4.0);
    EXPECT_EQ(history.samples().front().depth_mm, 0.5);
    EXPECT_EQ(history.samples().back().depth_mm, std::nullopt) << "a server that does not say";
}

TEST(ToolHistory, StartsAnewWithANewSession) {
    ToolHistory history;
    history.add(at_time(5.0));
    history.add(at_time(0.1));
    EXPECT_EQ(history.samples().size(), 1u);
}

}  // namespace
}  // namespace osteomill::tool_history_test
