#include "haptic_server/streaming/update_deadband.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace osteomill {
namespace {

const ToolState told{.time_s = 5.0,
                     .burr_position_mm = {1, 2, 3},
                     .hand_position_mm = {1, 2, 4},
                     .force_n = {0, 0, 1},
                     .burr = 1};

TEST(QuietTool, MayTrembleAndAge) {
    ToolState now = told;
    now.time_s += 0.09;
    now.taken_unix_ns += 90'000'000;
    now.burr_position_mm.x += 0.001;
    now.force_n.y -= 0.001;
    EXPECT_TRUE(is_within_deadband(told, now));
    now.time_s = 5.1;
    EXPECT_FALSE(is_within_deadband(told, now)) << "now and then it is told of, anyway";
    now.time_s = 4.9;
    EXPECT_FALSE(is_within_deadband(told, now)) << "time went back: another session or place in a recording";
}

TEST(QuietTool, DoesNothingThatAViewerWouldSee) {
    const std::vector<std::function<void(ToolState&)>> changes{
        [](ToolState& tool) { tool.burr_position_mm.z += 0.01; },
        [](ToolState& tool) { tool.hand_position_mm.x += 0.01; },
        [](ToolState& tool) {
            tool.spindle_axis = {0.001, 0, 1};
        },
        [](ToolState& tool) { tool.force_n.x = 0.01; },
        [](ToolState& tool) { tool.burr = 0; },
        [](ToolState& tool) { tool.spindle_on = true; },
        [](ToolState& tool) { tool.removed_mm3 = 1e-9; },
        [](ToolState& tool) { tool.touches_protected = true; },
        [](ToolState& tool) { tool.fixtures_on = 1; },
        [](ToolState& tool) { tool.fixtures_acting = 1; },
        [](ToolState& tool) { tool.fault = "the device is gone"; }};
    for (const auto& change : changes) {
        ToolState now = told;
        change(now);
        EXPECT_FALSE(looks_the_same(told, now)) << "change " << &change - changes.data();
    }
}

}  // namespace
}  // namespace osteomill
