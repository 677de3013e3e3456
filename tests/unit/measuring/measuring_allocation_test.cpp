// A tick of a measurement allocates nothing: this program counts every call of operator new.
#include <gtest/gtest.h>

#include "haptic_server/measuring/arm_shake.h"
#include "haptic_server/measuring/stiffness_ramp.h"
#include "tests/support/bench/fine_arm.h"
#include "tests/unit/loop/counting_new.h"

namespace osteomill::testing {
namespace {

/// In the ticks of `part` alone, to its end.
template <typename Part>
std::size_t allocations_of(Part& part, FineArm& arm, double& now_s) {
    std::size_t count = 0;
    for (; !part.is_over(); now_s += 1e-3) {
        const DeviceState state = arm.read(now_s);
        const std::size_t before = allocation_count();
        const glm::dvec3 force_n = part.tick(state, now_s);
        count += allocation_count() - before;
        arm.write(force_n);
    }
    return count;
}

TEST(Measuring, AllocatesNothingInItsTicks) {
    for (const double step_mm : {0.0, 0.055}) {
        FineArm arm({.step_mm = step_mm, .noise_mm = 0.001, .delay_ticks = 1.5}, 3);
        double now_s = 0.0;
        ArmShake shake(3.3);
        EXPECT_EQ(allocations_of(shake, arm, now_s), 0U);
        EXPECT_EQ(shake.end(), MeasuringEnd::done);
        StiffnessRamp ramp({.resolution_mm = step_mm, .moving_mass_kg = 0.145, .delay_ticks = 1.5},
                           shake.guard().again());
        EXPECT_EQ(allocations_of(ramp, arm, now_s), 0U);
        EXPECT_GT(ramp.calm_n_per_mm(), 1.0) << "there was something to do";
    }
}

}  // namespace
}  // namespace osteomill::testing
