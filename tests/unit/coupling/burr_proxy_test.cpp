#include "simulation/coupling/burr_proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace osteomill::burr_proxy_test {
namespace {

/// One patch facing +x that resists like a damper of `resistance` N s/mm.
std::unique_ptr<MillingResult> damper_along_x(double resistance_n_s_per_mm, double gap_mm) {
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->engagement.count = 1;
    result->engagement.patches[0] = {.normal = {1.0, 0.0, 0.0},
                                     .gap_mm = gap_mm,
                                     .cutting_n_s_per_mm = {-resistance_n_s_per_mm, 0.0, 0.0},
                                     .area_mm2 = 1.0};
    return result;
}

/// In a tick.
constexpr double most_slip_mm = 0.001 * BurrProxy::most_release_n_per_s / 1.5;

/// A tick toward a hand on a spring of 1.5 N/mm.
void advance(BurrProxy& proxy, const glm::dvec3& hand_mm, double tick_s, bool spindle_on,
             const MillingResult& bone) {
    proxy.advance(hand_mm, hand_mm, {1.5 * (hand_mm - proxy.position_mm()), 1.5}, tick_s, spindle_on, bone);
}

TEST(BurrProxy, FollowsTheHandThroughAir) {
    BurrProxy proxy;
    proxy.place({1.0, 2.0, 3.0});
    const auto air = std::make_unique<MillingResult>();
    advance(proxy, {4.0, 4.0, 4.0}, 0.001, true, *air);
    EXPECT_EQ(proxy.position_mm(), glm::dvec3(4.0, 4.0, 4.0));
    EXPECT_EQ(proxy.iterations(), 0) << "air costs nothing";
}

TEST(BurrProxy, SolvesTheOneDimensionalLaw) {
    // p' = (B/dt p + K x) / (B/dt + K)
    for (const double resistance : {1e-4, 0.1, 100.0}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = damper_along_x(resistance, 0.0);
        double expected = 0.0;
        for (int i = 0; i < 5; ++i) {
            advance(proxy, {0.5, 0.0, 0.0}, 0.001, true, *bone);
            const double b = resistance / 0.001;
            expected = (b * expected + 1.5 * 0.5) / (b + 1.5);
            EXPECT_NEAR(proxy.position_mm().x, expected, 1e-9);
        }
    }
}

/// A wall along y and z, at x = 0, for a burr at rest.
std::unique_ptr<MillingResult> wall_along_x() {
    auto result = damper_along_x(0.0, 0.0);
    result->engagement.patches[0].area_mm2 = 1.0;
    return result;
}

TEST(BurrProxy, IsHeldByFrictionOnAWallUntilTheHandOvercomesIt) {
    const auto wall = wall_along_x();
    for (const double friction : {0.0, 0.2}) {
        BurrProxy proxy(friction);
        proxy.place(glm::dvec3(0.0));
        // Pressed with 0.6 N and pulled aside with 0.09, then 0.3 N.
        for (int i = 0; i < 50; ++i) advance(proxy, {0.4, 0.06, 0.0}, 0.001, false, *wall);
        const double normal_n = 1.5 * (0.4 - proxy.position_mm().x);
        EXPECT_NEAR(normal_n, 0.6, 0.01);
        if (friction > 0.0) {
            EXPECT_LT(proxy.position_mm().y, 1e-3) << "sticks, but for the first tick's";
        } else {
            EXPECT_NEAR(proxy.position_mm().y, 0.06, 1e-9);
        }
        for (int i = 0; i < 50; ++i) advance(proxy, {0.4, 0.2, 0.0}, 0.001, false, *wall);
        EXPECT_NEAR(1.5 * (0.2 - proxy.position_mm().y), friction * normal_n, 1e-3) << "slides";
    }
}

/// One patch facing +x whose edges rub with 0.6 N.
std::unique_ptr<MillingResult> rubbing_along_x() {
    auto result = damper_along_x(0.02, 0.0);
    result->engagement.has_edge_force = true;
    result->engagement.patches[0].edge_n = {-0.6, 0.0, 0.0};
    return result;
}

/// The map that the milling loop samples after it has carved at the proxy's place. Its force is not checked.
void refresh(MillingResult& bone, const BurrProxy& proxy) {
    ++bone.step;
    bone.spindle_on = false;
    bone.engagement.burr_position_mm = proxy.carving_mm();
}

TEST(BurrProxy, IsHeldByEdgesThatRubUntilTheHandOvercomesThem) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto bone = rubbing_along_x();
    // 0.3 mm on 1.5 N/mm: 0.45 N. For a second, with a new map each tick, nothing creeps.
    for (int i = 0; i < 1000; ++i) {
        advance(proxy, {0.3, 0.0, 0.0}, 0.001, true, *bone);
        refresh(*bone, proxy);
    }
    EXPECT_LT(proxy.position_mm().x, BurrProxy::edge_yields_mm);
    EXPECT_EQ(proxy.carving_mm(), glm::dvec3(0.0)) << "nothing is cut";
    // 0.8 mm: 1.2 N, of which 0.6 N are left for chips. Then the burr stands where the spring holds 0.6 N.
    for (int i = 0; i < 2000; ++i) {
        advance(proxy, {0.8, 0.0, 0.0}, 0.001, true, *bone);
        refresh(*bone, proxy);
    }
    EXPECT_NEAR(proxy.position_mm().x, 0.4, 0.002);
    EXPECT_NEAR(proxy.carving_mm().x, proxy.position_mm().x, BurrProxy::carving_trails_mm + 1e-9);
}

TEST(BurrProxy, FeelsTheWholeEdgeForceHoweverSlowlyItCuts) {
    for (const double speed_mm_per_s : {0.2, 2.0, 20.0}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = rubbing_along_x();
        double hand_mm = 0.45;
        for (int i = 0; i < 3000; ++i) {
            hand_mm += 0.001 * speed_mm_per_s;
            advance(proxy, {hand_mm, 0.0, 0.0}, 0.001, true, *bone);
            refresh(*bone, proxy);
        }
        const double chip_n = 0.02 * speed_mm_per_s;
        EXPECT_NEAR(1.5 * (hand_mm - proxy.position_mm().x), 0.6 + chip_n, 0.01) << speed_mm_per_s;
    }
}

TEST(BurrProxy, MeetsBoneOnlyBeyondTheGapAndNeverTwice) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto bone = damper_along_x(1000.0, 0.1);
    advance(proxy, {0.3, 0.0, 0.0}, 0.001, true, *bone);
    EXPECT_NEAR(proxy.position_mm().x, 0.1, 1e-3);
    advance(proxy, {-0.3, 0.0, 0.0}, 0.001, true, *bone);
    EXPECT_NEAR(proxy.position_mm().x, -0.3, 1e-12) << "nothing holds it back";
    advance(proxy, {0.1, 0.0, 0.0}, 0.001, true, *bone);
    EXPECT_NEAR(proxy.position_mm().x, 0.1, 1e-12) << "cut already";
}

TEST(BurrProxy, TakesAPatchIntoContactByDegreesAsItsGapCloses) {
    // The gap of a rim scatters with the lattice by some hundredths of a voxel; the force must not jump.
    double last_mm = 0.0;
    for (double gap_voxels = 0.0; gap_voxels <= 0.2; gap_voxels += 0.005) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        advance(proxy, {0.005, 0.0, 0.0}, 0.001, true, *damper_along_x(0.001, 0.1 * gap_voxels));
        const double advance_mm = proxy.position_mm().x;
        if (gap_voxels == 0.0) {
            EXPECT_NEAR(advance_mm, 1.5 * 0.005 / (1.0 + 1.5), 1e-9);
        } else {
            EXPECT_GE(advance_mm, last_mm - 1e-12) << gap_voxels;
            EXPECT_LT(advance_mm - last_mm, 0.0005) << gap_voxels;
        }
        last_mm = advance_mm;
    }
    EXPECT_NEAR(last_mm, 0.005, 1e-12) << "and is free of it";
}

TEST(BurrProxy, StopsAtAWallWithTheSpindleOff) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto bone = damper_along_x(0.0, 0.1);
    for (int i = 0; i < 1000; ++i) advance(proxy, {2.0, 0.5, 0.0}, 0.001, false, *bone);
    // K (x - p) = k A (p - gap): 1.5 (2 - p) = 1000 (p - 0.1)
    EXPECT_NEAR(proxy.position_mm().x, (3.0 + 100.0) / 1001.5, 1e-9) << "and does not creep";
    EXPECT_NEAR(proxy.position_mm().y, 0.5, 1e-9) << "without friction";
}

TEST(BurrProxy, SolvesASidewaysForceStrongerThanTheDirectOne) {
    // A patch facing +x whose force is mostly along -y, as milling is.
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    auto bone = damper_along_x(0.05, 0.0);
    bone->engagement.patches[0].cutting_n_s_per_mm = {-0.05, -0.4, 0.0};
    advance(proxy, {0.01, 0.0, 0.0}, 0.001, true, *bone);
    const glm::dvec3 d = proxy.position_mm();
    EXPECT_NEAR(1.5 * (0.01 - d.x), 0.05 * d.x / 0.001, 1e-6);
    EXPECT_NEAR(1.5 * (0.0 - d.y), 0.4 * d.x / 0.001, 1e-6);
}

TEST(BurrProxy, LetsGoOverSomeTicksWhenTheBoneIsGone) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto hard = damper_along_x(100.0, 0.0);
    glm::dvec3 hand(0.0);
    for (int i = 0; i < 100; ++i) advance(proxy, hand += glm::dvec3(0.006, 0.0, 0.0), 0.001, true, *hard);
    double lag_mm = hand.x - proxy.position_mm().x;
    ASSERT_GT(lag_mm, 0.5);

    MillingResult air = *hard;
    air.step = 2;
    air.engagement.count = 0;
    for (int i = 0; i < 6; ++i) {
        advance(proxy, hand += glm::dvec3(0.006, 0.0, 0.0), 0.001, true, air);
        const double next_mm = hand.x - proxy.position_mm().x;
        EXPECT_LE(lag_mm - next_mm, most_slip_mm + 1e-12);
        lag_mm = next_mm;
    }
    EXPECT_NEAR(lag_mm, 0.0, 1e-12) << "and arrives";
}

TEST(BurrProxy, SlipsNoFasterPastAHandThatComesTowardIt) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    const auto hard = damper_along_x(100.0, 0.0);
    glm::dvec3 hand(0.0);
    for (int i = 0; i < 100; ++i) advance(proxy, hand += glm::dvec3(0.006, 0.0, 0.0), 0.001, true, *hard);
    MillingResult air = *hard;
    air.step = 2;
    air.engagement.count = 0;
    const double lag_mm = hand.x - proxy.position_mm().x;
    // An encoder's step toward the burr, in the tick in which the bone is gone.
    advance(proxy, hand -= glm::dvec3(0.055, 0.0, 0.0), 0.001, true, air);
    EXPECT_NEAR(lag_mm - (hand.x - proxy.position_mm().x), most_slip_mm, 1e-12);
}

/// A burr in a tunnel of its own width along z: patches all round it, edges that pull sideways six times as
/// hard as they push back, as in bone.
std::unique_ptr<MillingResult> tunnel(double resistance_n_s_per_mm) {
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    Engagement& engagement = result->engagement;
    engagement.count = 64;
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const double psi = 2.0 * std::numbers::pi * static_cast<double>(i) / 64.0;
        const glm::dvec3 normal(std::cos(psi), std::sin(psi), 0.0);
        const glm::dvec3 along(-std::sin(psi), std::cos(psi), 0.0);
        engagement.patches[i] = {.normal = normal,
                                 .cutting_n_s_per_mm = resistance_n_s_per_mm * (-normal - 6.0 * along),
                                 .area_mm2 = 0.1};
    }
    return result;
}

TEST(BurrProxy, EndsEveryTickInBalanceWhateverTheRingOfContacts) {
    for (const double resistance : {1e-4, 1e-3, 0.01, 0.1}) {
        BurrProxy proxy;
        proxy.place(glm::dvec3(0.0));
        const auto bone = tunnel(resistance);
        for (int i = 0; i < 3000; ++i) {
            // A hand that stirs, up to 1.5 N on the spring.
            const double turn = 0.013 * i;
            const glm::dvec3 hand(std::cos(turn) - 1.0, std::sin(1.7 * turn), 0.001 * i);
            advance(proxy, hand, 0.001, true, *bone);
            ASSERT_LE(glm::distance(proxy.position_mm(), hand), 3.0) << "nor does it run off";
        }
        EXPECT_LT(proxy.counts().max_residual_n, balance_tolerance_n) << resistance;
    }
}

/// The energy that a burr's spring gives a hand in a fifth of a second of motion along x and y together,
/// while bone before it (+x) pulls it along (+y).
double energy_to_hand_of_a_climb_mj(BurrProxy& proxy, double feed_mm_per_s) {
    auto bone = damper_along_x(0.01, 0.0);
    bone->engagement.patches[0].cutting_n_s_per_mm = {-0.01, 0.08, 0.0};
    const glm::dvec3 step_mm = 0.001 * feed_mm_per_s * glm::dvec3(1.0, 1.0, 0.0);
    glm::dvec3 hand(0.0);
    double energy_mj = 0.0;
    proxy.place(hand);
    for (int i = 0; i < 200; ++i) {
        energy_mj += glm::dot(1.5 * (proxy.position_mm() - hand), step_mm);
        hand += step_mm;
        advance(proxy, hand, 0.001, true, *bone);
    }
    return energy_mj;
}

TEST(BurrProxy, HandsOnAPartOfTheEnergyThatBoneGivesIt) {
    // By the law alone: (0.08 - 0.01) N s/mm times 50 mm/s, at 50 mm/s, for a fifth of a second: 35 mJ; at 10
    // mm/s 1.4 mJ.
    BurrProxy fast;
    EXPECT_LT(energy_to_hand_of_a_climb_mj(fast, 50.0), 0.5 * 35.0);
    EXPECT_GT(fast.counts().damped, 100U);
    BurrProxy slow;
    EXPECT_GT(energy_to_hand_of_a_climb_mj(slow, 10.0), 0.3 * 1.4) << "it is felt";
}

TEST(BurrProxy, DampsNothingWhereBoneTakesEnergy) {
    BurrProxy proxy;
    proxy.place(glm::dvec3(0.0));
    auto bone = damper_along_x(0.05, 0.0);
    bone->engagement.patches[0].cutting_n_s_per_mm = {-0.05, -0.02, 0.0};
    for (int i = 1; i <= 1000; ++i) advance(proxy, {0.01 * i, 0.0, 0.0}, 0.001, true, *bone);
    EXPECT_EQ(proxy.counts().damped, 0U);
    EXPECT_EQ(proxy.counts().fallbacks, 0U);
    // The spring holds the law's force, the damper none: F = (0.05, 0.02) N s/mm times 10 mm/s.
    EXPECT_NEAR(1.5 * (10.0 - proxy.position_mm().x), 0.5, 1e-3);
    EXPECT_NEAR(1.5 * proxy.position_mm().y, -0.2, 1e-3);
}

}  // namespace
}  // namespace osteomill::burr_proxy_test
