#include "devices/hid/arm_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_arm.h"
#include "tests/support/virtual_arm.h"

namespace osteomill {
namespace {

constexpr double half_pi = 0.5 * std::numbers::pi;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " " << b.z;
}

/// Derived by hand from the published geometry: L_c - o_x and L_a + L_b - o_z.
TEST(ArmKinematics, PutsWoodenHapticsAtHomeWhereItsGeometrySays) {
    const ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    const ArmKinematics arm(profile);
    expect_near(arm.position_mm({0.0, 0.0, half_pi}), {25.0, 0.0, 205.0}, 1e-9);
    // 6000 counts of 2000 are three turns; a capstan of 10 on 120 mm makes a quarter turn of them.
    expect_near(arm.angles_rad({0, 0, 6000}), {0.0, 0.0, half_pi}, 1e-12);
    expect_near(home_position_mm(profile), {25.0, 0.0, 205.0}, 1e-9);
}

TEST(ArmKinematics, TurnsPolhemsBodiesAgainstItsMotors) {
    const ArmProfile profile = load_arm_profile("polhem_v1");
    expect_near(ArmKinematics(profile).angles_rad({0, 0, -5000}), {0.0, 0.0, half_pi}, 1e-12);
    // L_c - o_x = 133 - 140, L_a + L_b - o_z = 58 + 174 - 100
    expect_near(home_position_mm(profile), {-7.0, 0.0, 132.0}, 1e-9);
}

TEST(ArmKinematics, HasTheJacobianOfItsPositionInEveryProfile) {
    for (const std::string& name : shipped_profile_names()) {
        const ArmKinematics arm(load_arm_profile(name));
        const glm::dvec3 angles(0.3, -0.2, 1.1);
        const glm::dmat3 jacobian = arm.jacobian_mm(angles);
        for (int i = 0; i < 3; ++i) {
            constexpr double step = 1e-6;
            glm::dvec3 to(angles), from(angles);
            to[i] += step;
            from[i] -= step;
            expect_near(jacobian[i], (arm.position_mm(to) - arm.position_mm(from)) / (2.0 * step), 1e-4);
        }
    }
}

/// The virtual work of a force is that of the motors: F . dx = sum k_i I_i d(motor angle)_i.
TEST(ArmKinematics, GivesCurrentsThatDoTheWorkOfTheForce) {
    for (const std::string& name : shipped_profile_names()) {
        const ArmProfile profile = load_arm_profile(name);
        const ArmKinematics arm(profile);
        const std::array<int, 3> counts = testing::counts_at(profile, {0.2, 0.1, 1.4});
        const glm::dvec3 force_n(1.0, -2.0, 0.5);
        const glm::dvec3 currents_a = arm.currents_a(arm.angles_rad(counts), force_n);
        for (std::size_t i = 0; i < 3; ++i) {
            std::array<int, 3> moved = counts;
            moved[i] += 1;
            const glm::dvec3 moved_m =
                0.001 * (arm.position_mm(arm.angles_rad(moved)) - arm.position_mm(arm.angles_rad(counts)));
            const double motor_work = profile.joints[i].torque_constant_nm_per_a *
                                      currents_a[static_cast<int>(i)] * 2.0 * std::numbers::pi /
                                      profile.joints[i].counts_per_rev;
            EXPECT_NEAR(motor_work, glm::dot(force_n, moved_m), 1e-3 * std::abs(motor_work) + 1e-9) << name;
        }
        expect_near(arm.force_n(arm.angles_rad(counts), currents_a), force_n, 1e-9);
    }
}

TEST(ArmKinematics, ReadsADirectionFromTheStylusOnlyWhereTheProfileHasOne) {
    const ArmKinematics wooden(load_arm_profile("woodenhaptics_v2015"));
    EXPECT_EQ(wooden.spindle_axis({0.4, 0.0, 1.0}, {100, 200, 300}), glm::dvec3(0.0, 0.0, 1.0));
    const ArmKinematics polhem(load_arm_profile("polhem_v1"));
    expect_near(polhem.spindle_axis({0.0, 0.0, half_pi}, {0, 0, 0}), {1.0, 0.0, 0.0}, 1e-12);
    // A quarter turn of E, counter e, about y takes x to -z.
    expect_near(polhem.spindle_axis({0.0, 0.0, half_pi}, {0, 256, 0}), {0.0, 0.0, -1.0}, 1e-12);
    // And the whole arm turned a quarter about z.
    expect_near(polhem.spindle_axis({half_pi, 0.0, half_pi}, {0, 0, 0}), {0.0, 1.0, 0.0}, 1e-12);
}

TEST(ArmKinematics, ResolvesWhatOneCountMoves) {
    const ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    // Body C: 245 mm, a 2000th of a turn through 10 on 120; A moves the same 245 mm by 10 on 160.
    const double c_mm = 245.0 * 2.0 * std::numbers::pi / 2000.0 / 12.0;
    EXPECT_NEAR(ArmKinematics(profile).resolution_mm(), c_mm, 1e-9);
}

TEST(CappedCurrents, KeepTheirDirectionAndTakeNoNonsense) {
    expect_near(capped_currents_a({1.0, -4.0, 2.0}, 2.0), {0.5, -2.0, 1.0}, 1e-12);
    EXPECT_EQ(capped_currents_a({1.0, -1.5, 0.0}, 2.0), glm::dvec3(1.0, -1.5, 0.0));
    EXPECT_EQ(capped_currents_a({NAN, 1.0, 0.0}, 2.0), glm::dvec3(0.0));
    EXPECT_EQ(capped_currents_a({HUGE_VAL, 1.0, 0.0}, 2.0), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill
