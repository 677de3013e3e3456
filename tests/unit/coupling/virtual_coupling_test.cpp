#include "simulation/coupling/virtual_coupling.h"

#include <gtest/gtest.h>

#include <memory>

namespace osteomill::virtual_coupling_test {
namespace {

constexpr PatientLimits device{.max_stiffness_n_per_mm = 1.5, .apparent_mass_kg = 0.045};

HandState hand_at(double x_mm) {
    return {.pose = {{x_mm, 0.0, 0.0}, {0.0, 0.0, 1.0}}, .spindle_on = true};
}

TEST(VirtualCoupling, FeelsTheToolsMassInAir) {
    VirtualCoupling coupling({.device = device});
    const MillingResult none{};
    CouplingOutput output;
    for (int tick = 0; tick < 1000; ++tick)  // 2 m/s^2
        output = coupling.tick(hand_at(1e3 * 0.5 * 2.0 * 1e-6 * tick * tick), none);
    EXPECT_NEAR(output.force_n.x, -0.045 * 2.0, 1e-6);
    EXPECT_NEAR(output.force_n.y, 0.0, 1e-12);
}

TEST(VirtualCoupling, PassesASteadyForceOnThroughASpringThatYields) {
    VirtualCoupling coupling({.device = device, .model_holds_wall = true});
    auto result = std::make_unique<MillingResult>();
    CouplingOutput output;
    for (int tick = 0; tick < 2000; ++tick) {
        ++result->step;
        result->force_n = {-0.6, 0.3, 0.0};
        output = coupling.tick(hand_at(5.0), *result);
    }
    EXPECT_NEAR(output.force_n.x, -0.6, 1e-9);
    EXPECT_NEAR(output.force_n.y, 0.3, 1e-9);
    EXPECT_NEAR(output.burr_pose.position_mm.x, 5.0 - 0.6 / 1.5, 1e-9);
}

TEST(VirtualCoupling, StartsAtTheHandAfterAReset) {
    VirtualCoupling coupling({.device = device});
    const MillingResult none{};
    for (int tick = 0; tick < 10; ++tick) (void)coupling.tick(hand_at(0.5 * tick), none);
    coupling.reset();
    const CouplingOutput output = coupling.tick(hand_at(-20.0), none);
    EXPECT_EQ(output.force_n, glm::dvec3(0.0));
    EXPECT_EQ(output.burr_pose.position_mm, hand_at(-20.0).pose.position_mm);
}

}  // namespace
}  // namespace osteomill::virtual_coupling_test
