#include "haptic_server/streaming/operator_activity.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

using std::chrono::seconds;

TEST(OperatorActivity, IsAnythingNewAndAPedalThatIsDown) {
    const OperatorActivity::Time start{};
    const auto rest = OperatorActivity::longest_rest;
    const OperatorCommand still{.hand_target_mm = {1, 2, 3}, .burr = 1};
    OperatorActivity activity;
    EXPECT_FALSE(activity.is_idle(start + 9 * rest)) << "nobody has begun";
    activity.note(still, start);
    activity.note(still, start + rest);
    EXPECT_FALSE(activity.is_idle(start + rest));
    EXPECT_TRUE(activity.is_idle(start + rest + seconds(1)));

    OperatorCommand moved = still;
    auto now = start;
    for (const auto& change : std::initializer_list<std::function<void(OperatorCommand&)>>{
             [](OperatorCommand& command) { command.hand_target_mm.x += 0.01; },
             [](OperatorCommand& command) {
                 command.spindle_axis = {0, 1, 0};
             },
             [](OperatorCommand& command) { command.burr = 0; },
             [](OperatorCommand& command) { command.pedal = true; },
             [](OperatorCommand&) {},  // it is down still
             [](OperatorCommand& command) { command.pedal = false; }}) {
        change(moved);
        activity.note(moved, now += 2 * rest);
        EXPECT_FALSE(activity.is_idle(now + rest));
    }
    activity.begin();
    EXPECT_FALSE(activity.is_idle(now + 9 * rest)) << "another has yet to begin";
}

}  // namespace
}  // namespace osteomill
