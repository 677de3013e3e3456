#include "haptic_server/coupling/implicit_coupling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/fresh_slot.h"
#include "tests/support/lockstep.h"

namespace osteomill {
namespace {

using testing::fresh_slot_force_n;
using testing::Lockstep;
using testing::make_block;

constexpr double spring_n_per_mm = 1.5;

Burr five_mm_burr() { return Burr{.name = "5 mm", .diameter_mm = 5.0}; }

struct Steady {
    glm::dvec3 mean_n{0.0};
    glm::dvec3 expected_n{0.0};
    double ripple_n = 0.0;
    double largest_jump_n = 0.0;
};

/// The hand moves along +x on rails; after it has settled, forces are averaged and compared with the closed form at the depth
/// at which the burr then really runs.
Steady cut_on_rails(double depth_mm, double feed_mm_per_s, double rpm, int ticks_per_step) {
    Burr burr = five_mm_burr();
    burr.spindle_rev_per_s = rpm / 60.0;
    ImplicitCoupling coupling({.device = {.max_stiffness_n_per_mm = spring_n_per_mm}});
    Lockstep loop(coupling, make_block({-1.0, -6.0, -6.0}, {14.0, 8.0, 0.0}, 0.1), burr, ticks_per_step);
    const double height = 2.5 - depth_mm;
    const auto hand = [&](double travel) { return glm::dvec3(-4.0 + travel, 0.013, height); };
    const double settled_mm = 10.0;
    Steady steady;
    glm::dvec3 squares(0.0);
    glm::dvec3 before(0.0);
    double depth_sum = 0.0;
    int samples = 0;
    for (int tick = 0;; ++tick) {
        const double travel = feed_mm_per_s * 0.001 * tick;
        if (travel > settled_mm + 2.0) break;
        const CouplingOutput out = loop.tick(hand(travel), true);
        if (tick > 0) steady.largest_jump_n = std::max(steady.largest_jump_n, glm::length(out.force_n - before));
        before = out.force_n;
        if (travel < settled_mm) continue;
        steady.mean_n += out.force_n;
        squares += out.force_n * out.force_n;
        depth_sum += 2.5 - out.burr_pose.position_mm.z;
        ++samples;
    }
    steady.mean_n /= samples;
    const glm::dvec3 variance = squares / static_cast<double>(samples) - steady.mean_n * steady.mean_n;
    steady.ripple_n = std::sqrt(std::max(0.0, variance.x + variance.y + variance.z));
    steady.expected_n = fresh_slot_force_n(burr, feed_mm_per_s, depth_sum / samples);
    return steady;
}

TEST(ImplicitCoupling, RendersTheModelsForceInSteadyCutting) {
    struct Case {
        double depth_mm, feed_mm_per_s, rpm;
        int ticks_per_step;
    };
    for (const Case& c : {Case{0.5, 6.0, 10'000.0, 1}, Case{1.5, 6.0, 10'000.0, 1}, Case{1.5, 6.0, 40'000.0, 1},
                          Case{1.5, 20.0, 40'000.0, 1}, Case{1.5, 6.0, 10'000.0, 10}}) {
        const Steady steady = cut_on_rails(c.depth_mm, c.feed_mm_per_s, c.rpm, c.ticks_per_step);
        const double error = glm::length(steady.mean_n - steady.expected_n) / glm::length(steady.expected_n);
        std::printf("d %.1f v %.0f rpm %.0f /%d: %.4f %.4f %.4f expected %.4f %.4f %.4f err %.3f ripple %.4f jump %.4f\n", c.depth_mm, c.feed_mm_per_s, c.rpm, c.ticks_per_step, steady.mean_n.x, steady.mean_n.y, steady.mean_n.z, steady.expected_n.x, steady.expected_n.y, steady.expected_n.z, error, steady.ripple_n / glm::length(steady.mean_n), steady.largest_jump_n);
        EXPECT_LT(error, 0.05);
    }
}

}  // namespace
}  // namespace osteomill
