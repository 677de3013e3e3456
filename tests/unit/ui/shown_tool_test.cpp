#include "render_client/ui/view/shown_tool.h"

#include <gtest/gtest.h>

#include "common/scene/scene_file.h"

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

TEST(ShownTool, HasTheShankThatTheSessionsSceneGivesItsBurr) {
    Scene scene;
    scene.name = "shanks";
    scene.burrs = {Burr{.name = "usual"}, Burr{.name = "long", .shank = {{2.0, 0.5}, {20.0, 0.75}}}};
    SessionInfo session{.burrs = scene.burrs, .scene_toml = write_scene(scene, SceneText::complete)};
    for (Burr& burr : session.burrs) burr.shank.clear();  // as a hello describes them
    const auto shank_of = [&](std::size_t burr) {
        ShownTool tool;
        ToolState state;
        state.burr = burr;
        tool.take(state);
        tool.turn(0.02, &session);
        return tool.drawn(state, &session, std::nullopt).burr.shank;
    };
    EXPECT_EQ(shank_of(0), ShankProfile{});
    EXPECT_EQ(shank_of(1), scene.burrs[1].shank);
    session.scene_toml = "no scene = [";
    EXPECT_EQ(shank_of(1), ShankProfile{}) << "the usual one";
    session.scene_toml.clear();
    EXPECT_EQ(shank_of(1), ShankProfile{});
}

}  // namespace
}  // namespace osteomill
