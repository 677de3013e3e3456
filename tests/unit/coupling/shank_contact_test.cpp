// The force on a hand by the shank behind its burr.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>

#include "simulation/coupling/implicit_coupling.h"
#include "tests/support/lockstep.h"

namespace osteomill::shank_contact_test {
namespace {

using testing::Lockstep;

constexpr double spring_n_per_mm = 1.5;

Burr burr_with(const ShankProfile& shank) {
    return {.name = "2 mm", .diameter_mm = 2.0, .shank = shank};
}

/// A patch of the shank ten millimetres up that faces +x, and a burr in air.
std::unique_ptr<MillingResult> wall_along_x(double gap_mm) {
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->engagement.shank_count = 1;
    result->engagement.shank_patches[0] = {
        .normal = {1.0, 0.0, 0.0}, .gap_mm = gap_mm, .area_mm2 = 0.5, .arm_mm = {0.4, 0.0, 10.0}};
    return result;
}

void advance(BurrProxy& proxy, const glm::dvec3& hand_mm, bool spindle_on, const MillingResult& bone) {
    proxy.advance(hand_mm, hand_mm, {spring_n_per_mm * (hand_mm - proxy.position_mm()), spring_n_per_mm},
                  0.001, spindle_on, bone);
}

TEST(ShankContact, IsAWallWithTheSpindleOnAndOff) {
    for (const bool spindle_on : {false, true}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = wall_along_x(0.1);
        for (int i = 1; i <= 1000; ++i) advance(proxy, {0.001 * i, 0.002 * i, 0.0}, spindle_on, *bone);
        // K (x - p) = k A (p - gap)
        EXPECT_NEAR(proxy.position_mm().x, (1.5 * 1.0 + 500.0 * 0.1) / 501.5, 1e-9) << spindle_on;
        EXPECT_NEAR(proxy.position_mm().y, 2.0, 1e-9) << "and free along it";
        EXPECT_TRUE(proxy.touches_wall());
        advance(proxy, {0.0, 2.0, 0.0}, spindle_on, *bone);
        EXPECT_FALSE(proxy.touches_wall());
        EXPECT_EQ(proxy.shank_torque_n_mm(), glm::dvec3(0.0));
    }
}

TEST(HeadOnWhatNoBurrCuts, MeetsAWallWithTheSpindleOnAndOff) {
    for (const bool spindle_on : {false, true}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        auto bone = std::make_unique<MillingResult>();
        bone->step = 1;
        bone->engagement.count = 1;
        bone->engagement.has_walls = true;
        bone->engagement.patches[0] = {
            .normal = {1.0, 0.0, 0.0}, .gap_mm = 0.1, .area_mm2 = 0.5, .is_wall = true};
        for (int i = 1; i <= 1000; ++i) advance(proxy, {0.001 * i, 0.002 * i, 0.0}, spindle_on, *bone);
        EXPECT_NEAR(proxy.position_mm().x, (1.5 * 1.0 + 500.0 * 0.1) / 501.5, 1e-9) << spindle_on;
        EXPECT_NEAR(proxy.position_mm().y, 2.0, 1e-9) << "and free along it";
        EXPECT_EQ(proxy.shank_torque_n_mm(), glm::dvec3(0.0));
    }
}

TEST(ShankContact, TurnsTheToolAboutTheBurr) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto bone = wall_along_x(0.0);
    for (const bool spindle_on : {false, true}) {
        advance(proxy, {0.4, 0.0, 0.0}, spindle_on, *bone);
        // Bone pushes with 0.6 N toward -x, 10 mm above the burr: the tool would tip over toward -x.
        const double force_n = 1.5 * (0.4 - proxy.position_mm().x);
        EXPECT_NEAR(force_n, 0.6, 0.01);
        EXPECT_NEAR(proxy.shank_torque_n_mm().y, -10.0 * force_n, 1e-9);
        EXPECT_NEAR(proxy.shank_torque_n_mm().x, 0.0, 1e-12);
        EXPECT_NEAR(proxy.shank_torque_n_mm().z, 0.0, 1e-12);
    }
    proxy.place(glm::dvec3(0.0));
    EXPECT_EQ(proxy.shank_torque_n_mm(), glm::dvec3(0.0));
}

TEST(ShankContact, IsNoCuttingForceToTheCorrection) {
    // The burr cuts downward as the model says it does, pressed against a wall or not.
    const auto depth_after = [](bool has_wall) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = wall_along_x(0.0);
        if (!has_wall) bone->engagement.shank_count = 0;
        bone->spindle_on = true;
        bone->engagement.count = 1;
        bone->engagement.patches[0] = {
            .normal = {0.0, 0.0, -1.0}, .cutting_n_s_per_mm = {0.0, 0.02, 0.1}, .area_mm2 = 1.0};
        for (int i = 1; i <= 500; ++i) {
            const double before_mm = proxy.position_mm().z;
            advance(proxy, {0.3, 0.0, -0.005 * i}, true, *bone);
            ++bone->step;
            bone->time_s = 0.001 * i;
            bone->engagement.burr_position_mm = proxy.position_mm();
            // The wall stays where it is.
            bone->engagement.shank_patches[0].gap_mm = -proxy.position_mm().x;
            bone->force_n = (before_mm - proxy.position_mm().z) / 0.001 * glm::dvec3(0.0, 0.02, 0.1);
        }
        return proxy.position_mm();
    };
    const glm::dvec3 free = depth_after(false);
    const glm::dvec3 guided = depth_after(true);
    EXPECT_LT(guided.x, 0.01);
    EXPECT_NEAR(free.x, 0.3, 1e-6);
    EXPECT_NEAR(guided.z, free.z, 1e-6);
    EXPECT_NEAR(guided.y, free.y, 1e-6);
}

TEST(ShankContact, WallThatLetsGoIsNoBoneThatDrivesTheBurr) {
    // Hard by, and pushed into it by 3 N: it comes out by 0.1 mm, which a cutting edge would not be allowed.
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto bone = wall_along_x(-0.1);
    for (int i = 0; i < 100; ++i) advance(proxy, {2.0, 0.0, 0.0}, true, *bone);
    EXPECT_LT(proxy.position_mm().x, -0.09);
    EXPECT_EQ(proxy.counts().damped, 0U);
    EXPECT_EQ(proxy.counts().fallbacks, 0U);
}

TEST(ShankContact, BoneThatATiltedShankIsInPushesItOutGentlyAndAllTheWay) {
    // Nothing pressed it in by 0.1 mm: the hand turned the tool, which it can do without meeting resistance.
    for (const bool spindle_on : {false, true}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = wall_along_x(-0.1);
        double before_mm = 0.0;
        for (int i = 0; i < 100; ++i) {
            advance(proxy, {0.0, 0.0, 0.0}, spindle_on, *bone);
            EXPECT_LT(spring_n_per_mm * (before_mm - proxy.position_mm().x), 0.01) << "N in a tick, " << i;
            before_mm = proxy.position_mm().x;
        }
        EXPECT_NEAR(proxy.position_mm().x, -0.1, 0.001) << spindle_on;
    }
}

/// Draws the hand from one place to another at 10 mm/s and lets it rest there; returns the burr's place then,
/// the force on the hand, and the torque.
CouplingOutput draw(Lockstep& loop, const glm::dvec3& from_mm, const glm::dvec3& to_mm, bool spindle_on) {
    const int ticks = static_cast<int>(100.0 * glm::distance(from_mm, to_mm));
    for (int i = 0; i < ticks; ++i)
        (void)loop.tick(from_mm + (to_mm - from_mm) * (1.0 * i / ticks), spindle_on);
    CouplingOutput last;
    for (int i = 0; i < 1000; ++i) last = loop.tick(to_mm, spindle_on);
    return last;
}

TEST(ShankContact, StopsAtAnOverhangAboveAFreeBurr) {
    // Bone beyond x = 0.5 from z = 3 on; the burr is below, in the air, its shank 0.4 mm.
    const auto overhang = [](const glm::dvec3& p) { return std::min(p.x - 0.5, p.z - 3.0); };
    for (const bool spindle_on : {false, true})
        for (const bool has_shank : {false, true}) {
            ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
            Lockstep loop(coupling, testing::make_block({-3.0, -3.0, -3.0}, {4.0, 3.0, 9.0}, 0.1, overhang),
                          burr_with(has_shank ? ShankProfile{{1.2, 0.4}, {9.0, 0.4}} : ShankProfile{}), 1);
            const CouplingOutput out = draw(loop, {-1.0, 0.013, 0.017}, {1.1, 0.013, 0.017}, spindle_on);
            if (!has_shank) {
                EXPECT_NEAR(out.burr_pose.position_mm.x, 1.1, 1e-9) << "nothing is in the burr's way";
                EXPECT_NEAR(glm::length(out.force_n), 0.0, 1e-9);
                continue;
            }
            EXPECT_NEAR(out.burr_pose.position_mm.x, 0.1, 0.03) << spindle_on;
            EXPECT_NEAR(out.force_n.x, -1.5, 0.05) << spindle_on;
            // Somewhere between 3 and 9 mm above the burr.
            EXPECT_LT(out.shank_torque_n_mm.y, -3.0 * 1.4);
            EXPECT_GT(out.shank_torque_n_mm.y, -9.0 * 1.6);
            EXPECT_NEAR(out.burr_pose.position_mm.z, 0.017, 0.01);
        }
}

TEST(ShankContact, IsGuidedByADeepNarrowHole) {
    // A hole of 2.1 mm, 8 mm deep, and a shank nearly as wide as the burr.
    const auto around_hole = [](const glm::dvec3& p) {
        return p.z < -8.0 ? 1.0 : std::hypot(p.x, p.y) - 1.05;
    };
    const auto run = [&](const ShankProfile& shank, bool spindle_on) {
        ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
        Lockstep loop(coupling, testing::make_block({-3.0, -3.0, -10.0}, {3.0, 3.0, 0.0}, 0.1, around_hole),
                      burr_with(shank), 1);
        const glm::dvec3 deep(0.0, 0.0, -6.8);
        (void)draw(loop, {0.0, 0.0, 3.0}, deep, spindle_on);
        const glm::dvec3 aside = draw(loop, deep, {0.8, 0.3, -6.8}, spindle_on).burr_pose.position_mm;
        const CouplingOutput raised = draw(loop, {0.8, 0.3, -6.8}, {0.8, 0.3, -3.0}, spindle_on);
        EXPECT_LT(coupling.solve_counts().max_residual_n, balance_tolerance_n);
        EXPECT_EQ(coupling.solve_counts().relaxed, 0U);
        return std::pair{aside, raised.burr_pose.position_mm};
    };
    const ShankProfile wide{{1.2, 0.95}, {20.0, 0.95}};
    for (const bool spindle_on : {false, true}) {
        const auto [aside, raised] = run(wide, spindle_on);
        EXPECT_LT(glm::length(glm::dvec2(aside)), 0.13) << spindle_on;
        EXPECT_NEAR(aside.z, -6.8, 0.03);
        EXPECT_LT(glm::length(glm::dvec2(raised)), 0.13) << spindle_on;
        EXPECT_NEAR(raised.z, -3.0, 0.03) << "and free along the hole";
    }
    EXPECT_GT(run({}, true).first.x, 0.5) << "without a shank it cuts its way";
}

TEST(ShankContact, IsNotFeltInAir) {
    ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
    Lockstep loop(coupling, testing::make_block({-3.0, -3.0, -3.0}, {3.0, 3.0, 0.0}, 0.1),
                  burr_with({{1.2, 0.4}, {50.0, 10.0}}), 1);
    for (const bool spindle_on : {false, true})
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 hand(std::sin(0.02 * i), 0.0, 3.0 - 0.003 * i);
            const CouplingOutput out = loop.tick(hand, spindle_on);
            ASSERT_EQ(out.force_n, glm::dvec3(0.0)) << i;
            ASSERT_EQ(out.burr_pose.position_mm, hand);
            ASSERT_EQ(out.shank_torque_n_mm, glm::dvec3(0.0));
        }
}

}  // namespace
}  // namespace osteomill::shank_contact_test
