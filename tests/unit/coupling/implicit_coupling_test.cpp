#include "simulation/coupling/implicit_coupling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <tuple>

#include "tests/support/lockstep.h"

namespace osteomill::implicit_coupling_test {
namespace {

using testing::Lockstep;
using testing::make_block;

constexpr double spring_n_per_mm = 1.5;

Burr five_mm_burr() {
    return Burr{.name = "5 mm", .diameter_mm = 5.0};
}

struct Steady {
    glm::dvec3 rendered_n{0.0};  ///< mean force on the hand
    glm::dvec3 model_n{0.0};     ///< mean force of the milling model for the path that the burr really took
    double largest_jump_n = 0.0;
    double burr_depth_mm = 0.0;  ///< mean
    double noise_n = 0.0;        ///< rms of the change of force from tick to tick
};

/// The hand moves along +x on rails, its burr `depth_mm` deep if it did not yield; means over the last 3 mm.
Steady cut_on_rails(double depth_mm, double feed_mm_per_s, double rpm, int ticks_per_step) {
    Burr burr = five_mm_burr();
    burr.spindle_rev_per_s = rpm / 60.0;
    ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
    Lockstep loop(coupling, make_block({-1.0, -6.0, -6.0}, {12.0, 8.0, 0.0}, 0.1), burr, ticks_per_step);
    Steady steady;
    glm::dvec3 before(0.0);
    int samples = 0;
    double squared_jumps = 0.0;
    for (int tick = 0; feed_mm_per_s * 0.001 * tick < 12.0; ++tick) {
        const double travel_mm = feed_mm_per_s * 0.001 * tick;
        const CouplingOutput out = loop.tick({-4.0 + travel_mm, 0.013, 2.5 - depth_mm}, true);
        const double jump = glm::length(out.force_n - before);
        if (tick > 0) steady.largest_jump_n = std::max(steady.largest_jump_n, jump);
        before = out.force_n;
        if (travel_mm < 9.0) continue;
        steady.rendered_n += out.force_n;
        steady.model_n += loop.result().force_n;
        steady.burr_depth_mm += 2.5 - out.burr_pose.position_mm.z;
        squared_jumps += jump * jump;
        ++samples;
    }
    steady.rendered_n /= samples;
    steady.model_n /= samples;
    steady.burr_depth_mm /= samples;
    steady.noise_n = std::sqrt(squared_jumps / samples);
    return steady;
}

TEST(ImplicitCoupling, LetsGoBySpringAndDamperTogetherNoFasterThanIsFelt) {
    // Through the end of a block, with the spring stretched as far as a fast hand does.
    for (const double feed_mm_per_s : {20.0, 60.0}) {
        Burr burr = five_mm_burr();
        burr.spindle_rev_per_s = 5'000.0 / 60.0;
        ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
        Lockstep loop(coupling, make_block({-1.0, -6.0, -6.0}, {4.0, 8.0, 0.0}, 0.1), burr, 1);
        glm::dvec3 before(0.0);
        double peak_n = 0.0, largest_release_n = 0.0;
        for (int tick = 0; tick < 1500; ++tick) {
            const double travel_mm = std::min(feed_mm_per_s * 0.001 * tick, 16.0);
            const glm::dvec3 force_n = loop.tick({-4.0 + travel_mm, 0.013, 1.0}, true).force_n;
            if (glm::length(force_n) < glm::length(before))
                largest_release_n = std::max(largest_release_n, glm::distance(force_n, before));
            peak_n = std::max(peak_n, glm::length(force_n));
            before = force_n;
        }
        EXPECT_GT(peak_n, 1.0) << feed_mm_per_s;
        EXPECT_EQ(before, glm::dvec3(0.0)) << feed_mm_per_s;
        EXPECT_LE(largest_release_n, 0.15 + 1e-9) << feed_mm_per_s;
        RecordProperty("largest_release_n", std::to_string(largest_release_n));
    }
}

class SteadyCut : public ::testing::TestWithParam<std::tuple<double, double, double, int>> {};

TEST_P(SteadyCut, RendersTheForceOfTheMillingModelWithoutChatter) {
    const auto [depth_mm, feed_mm_per_s, rpm, ticks_per_step] = GetParam();
    const Steady steady = cut_on_rails(depth_mm, feed_mm_per_s, rpm, ticks_per_step);
    ASSERT_GT(glm::length(steady.model_n), 0.02);
    const double error = glm::length(steady.rendered_n - steady.model_n) / glm::length(steady.model_n);
    RecordProperty("error_percent", std::to_string(100.0 * error));
    RecordProperty("force_n", std::to_string(glm::length(steady.model_n)));
    RecordProperty("noise_n", std::to_string(steady.noise_n));
    RecordProperty("largest_jump_n", std::to_string(steady.largest_jump_n));
    EXPECT_LT(error, 0.05);
    EXPECT_LT(steady.noise_n, 0.02 * glm::length(steady.model_n) + 0.002);
    EXPECT_LT(steady.largest_jump_n, 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    ImplicitCoupling, SteadyCut,
    ::testing::Values(std::tuple{0.3, 6.0, 10'000.0, 1}, std::tuple{0.5, 6.0, 10'000.0, 1},
                      std::tuple{1.5, 6.0, 10'000.0, 1}, std::tuple{3.5, 6.0, 10'000.0, 1},
                      std::tuple{1.5, 6.0, 40'000.0, 1}, std::tuple{1.5, 20.0, 40'000.0, 1},
                      std::tuple{1.5, 6.0, 80'000.0, 1}, std::tuple{1.5, 3.0, 5'000.0, 1},
                      std::tuple{1.5, 6.0, 10'000.0, 10}));

TEST(ImplicitCoupling, IsNotFeltInAir) {
    ImplicitCoupling coupling({});
    Lockstep loop(coupling, make_block({-1.0, -1.0, -2.0}, {1.0, 1.0, 0.0}, 0.1), five_mm_burr(), 1);
    for (int tick = 0; tick < 200; ++tick) {
        const glm::dvec3 hand(0.2 * tick, std::sin(0.3 * tick), 4.0);
        const CouplingOutput out = loop.tick(hand, tick % 2 == 0);
        EXPECT_EQ(out.force_n, glm::dvec3(0.0));
        EXPECT_EQ(out.burr_pose.position_mm, hand);
    }
}

TEST(ImplicitCoupling, BoneIsAWallWhileTheSpindleIsOff) {
    ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
    Lockstep loop(coupling, make_block({-4.0, -4.0, -3.0}, {4.0, 4.0, 0.0}, 0.1), five_mm_burr(), 1);
    CouplingOutput out;
    double height = 3.0;
    for (int tick = 0; tick < 3000; ++tick) {
        height = std::max(1.5, height - 0.002);  // at last 1 mm into the bone
        out = loop.tick({0.0, 0.0, height}, false);
    }
    EXPECT_EQ(loop.model().bone().fraction_at({40, 40, 29}), 255) << "nothing was cut";
    EXPECT_NEAR(out.burr_pose.position_mm.z, 2.5, 0.05) << "the burr stays on the surface";
    EXPECT_NEAR(out.force_n.z, spring_n_per_mm * 1.0, 0.08);
    EXPECT_NEAR(std::hypot(out.force_n.x, out.force_n.y), 0.0, 0.02);
    for (int tick = 0; tick < 3000; ++tick) {
        const double before = out.force_n.z;
        out = loop.tick({0.0, 0.0, height}, false);
        EXPECT_NEAR(out.force_n.z, before, 0.01) << "no chatter, no creep";
    }
    EXPECT_NEAR(out.force_n.z, spring_n_per_mm * 1.0, 0.08);
}

TEST(ImplicitCoupling, StartsWithoutAForceWhereverTheHandIs) {
    ImplicitCoupling coupling({});
    const MillingResult none{};
    for (const glm::dvec3 place : {glm::dvec3(5.0), glm::dvec3(-40.0, 3.0, 9.0)}) {
        coupling.reset();
        EXPECT_EQ(coupling.tick({.pose = {place, {0.0, 0.0, 1.0}}}, none).force_n, glm::dvec3(0.0));
    }
}

}  // namespace
}  // namespace osteomill::implicit_coupling_test
