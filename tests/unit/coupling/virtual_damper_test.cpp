#include "simulation/coupling/virtual_damper.h"

#include <gtest/gtest.h>

#include "tests/unit/coupling/scripted_coupling.h"

namespace osteomill::virtual_damper_test {
namespace {

using testing::Script;
using testing::ScriptedCoupling;

const MillingResult none{};
const HandState moving{.pose = {}, .velocity_mm_per_s = {0.0, 40.0, -20.0}};

TEST(VirtualDamper, ResistsMotionInContactOnly) {
    Script base;
    VirtualDamper damper(std::make_unique<ScriptedCoupling>(base), {});
    EXPECT_EQ(damper.tick(moving, none).force_n, glm::dvec3(0.0)) << "air is free";
    base.says.force_n = {1.0, 0.0, 0.0};
    const glm::dvec3 force_n = damper.tick(moving, none).force_n;
    EXPECT_NEAR(force_n.x, 1.0, 1e-12);
    EXPECT_NEAR(force_n.y, -0.2, 1e-12);  // 5 N s/m x 40 mm/s
    EXPECT_NEAR(force_n.z, 0.1, 1e-12);
    base.says.force_n = {0.1, 0.0, 0.0};
    EXPECT_NEAR(damper.tick(moving, none).force_n.y, -0.1, 1e-12) << "half the damping at half of F_full";
}

TEST(VirtualDamper, LeavesTheBurrAndPassesAResetOn) {
    Script base;
    base.says.burr_pose.position_mm = {3.0, 2.0, 1.0};
    VirtualDamper damper(std::make_unique<ScriptedCoupling>(base), {});
    EXPECT_EQ(damper.tick(moving, none).burr_pose.position_mm, base.says.burr_pose.position_mm);
    damper.reset();
    EXPECT_EQ(base.resets, 1);
}

}  // namespace
}  // namespace osteomill::virtual_damper_test
