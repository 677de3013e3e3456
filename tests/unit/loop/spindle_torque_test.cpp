#include "simulation/loop/spindle_torque.h"

#include <gtest/gtest.h>

#include <numbers>

#include "devices/simulated/simulated_device.h"
#include "simulation/loop/milling_session.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

/// The work that a cavity's chips take is K_t for each mm^3, whatever the path: of a law without edges it is
/// the spindle's.
TEST(SpindleTorque, DoesTheWorkOfTheChips) {
    Scene scene;
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0}};
    scene.start_pose = {{0.0, 0.0, 2.5}, {0.0, 0.0, 1.0}};
    scene.trajectory = {
        .source = BuiltInTrajectory::cavity, .speed_mm_per_s = 8.0, .depth_mm = 0.8, .width_mm = 3.0};
    SimulatedDevice device(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, 0), scene.device,
                           ArmModel{}, hand_model(Grip::firm));
    const MillingSessionOptions options{
        .clock = ClockKind::virtual_time, .force_model = "published", .duration_s = 9.0};
    MillingSession session(scene, testing::make_block({-4.0, -4.0, -3.2}, {4.0, 4.0, 0.0}, 0.1), device,
                           options);
    session.start();
    session.advance(1);
    glm::dvec3 before_mm = session.newest_state().burr_position_mm;
    double work_mj = 0.0;
    for (int tick = 0; tick < 3000; ++tick) {
        session.advance(1);
        const ToolState& tool = session.newest_state();
        const glm::dvec3 feed_mm_per_s = (tool.burr_position_mm - before_mm) / MillingSession::tick_s;
        before_mm = tool.burr_position_mm;
        if (!tool.spindle_on) continue;
        const double torque_n_mm = spindle_torque_n_mm(session.known_result(), scene.burrs[0], feed_mm_per_s);
        work_mj +=
            MillingSession::tick_s * 2.0 * std::numbers::pi * scene.burrs[0].spindle_rev_per_s * torque_n_mm;
    }
    const double chips_mj = scene.burrs[0].cutting_coefficients_n_per_mm2.x * session.removed_mm3(0);
    EXPECT_GT(chips_mj, 100.0);
    EXPECT_NEAR(work_mj / chips_mj, 1.0, 0.1);
}

TEST(SpindleTorque, IsNoneInAir) {
    EXPECT_EQ(spindle_torque_n_mm({}, Burr{}, {0.0, 0.0, -10.0}), 0.0);
}

}  // namespace
}  // namespace osteomill
