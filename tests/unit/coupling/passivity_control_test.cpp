#include "simulation/coupling/passivity_control.h"

#include <gtest/gtest.h>

#include "tests/unit/coupling/scripted_coupling.h"

namespace osteomill::passivity_control_test {
namespace {

using testing::Script;
using testing::ScriptedCoupling;

const MillingResult none{};

struct Rig {
    Script base;
    PassivityControl control{std::make_unique<ScriptedCoupling>(base), {.device = {.apparent_mass_kg = 0.1}}};

    /// The force along x while the base says `base_n`, with the hand at `x_mm`.
    double tick(double x_mm, double base_n) {
        base.says.force_n = {base_n, 0.0, 0.0};
        return control.tick({.pose = {{x_mm, 0.0, 0.0}, {0.0, 0.0, 1.0}}}, none).force_n.x;
    }
};

TEST(PassivityControl, LeavesAForceAloneThatTakesMoreThanItGives) {
    Rig rig;
    for (int tick = 0; tick < 10; ++tick) EXPECT_EQ(rig.tick(0.01 * tick, -1.0), -1.0);
    EXPECT_NEAR(rig.control.taken_mj(), 0.09, 1e-12);
    for (int tick = 9; tick >= 0; --tick) EXPECT_EQ(rig.tick(0.01 * tick, -1.0), -1.0) << "gives it back";
}

TEST(PassivityControl, PairsTheHeldForceWithTheDisplacementThatItActedOver) {
    // An ideal spring, held: into the wall and out again by one step leaks K s^2. Paired with the
    // displacement before it, the same force would seem to have taken as much.
    Rig rig;
    (void)rig.tick(0.0, 0.0);
    (void)rig.tick(0.1, -0.1);
    (void)rig.tick(0.0, 0.0);
    EXPECT_NEAR(rig.control.taken_mj(), -0.1 * 0.1, 1e-12);
}

TEST(PassivityControl, PaysBackWhatWasGivenOverTheNextStep) {
    Rig rig;
    (void)rig.tick(0.0, 1.0);
    // Given 0.02 mJ on the way here; a damper that takes as much over another 0.02 mm: 1 N.
    EXPECT_NEAR(rig.tick(0.02, 1.0), 0.0, 1e-9);
    EXPECT_NEAR(rig.control.taken_mj(), -0.02, 1e-12);
}

TEST(PassivityControl, DampsNoMoreThanASampledArmBears) {
    Rig rig;
    (void)rig.tick(0.0, 3.0);
    // 0.003 mJ over 0.001 mm would need 3000 N s/m; m / (2 T) = 50.
    EXPECT_NEAR(rig.tick(0.001, 3.0), 3.0 - 50.0 * 0.001, 1e-9);
}

TEST(PassivityControl, ForgetsCreditButNoDebtWhenContactEnds) {
    Rig rig;
    (void)rig.tick(0.0, -1.0);
    (void)rig.tick(0.1, 0.0);
    EXPECT_EQ(rig.control.taken_mj(), 0.0);
    (void)rig.tick(0.1, -1.0);
    (void)rig.tick(0.0, 0.0);
    EXPECT_NEAR(rig.control.taken_mj(), -0.1, 1e-12);
    rig.control.reset();
    EXPECT_EQ(rig.control.taken_mj(), 0.0);
    EXPECT_EQ(rig.base.resets, 1);
}

}  // namespace
}  // namespace osteomill::passivity_control_test
