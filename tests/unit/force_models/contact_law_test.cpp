// Duties of every contact law on a flat block, whatever its formula.
#include "simulation/force_models/contact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <ostream>

#include "simulation/force_models/hertz_contact.h"
#include "simulation/force_models/petersik_probe.h"
#include "simulation/force_models/point_spring.h"
#include "simulation/force_models/voxel_tool.h"
#include "tests/unit/force_models/contact_bench.h"

namespace osteomill::contact_law_test {
namespace {

using testing::ContactBench;
using testing::remove_where;
using testing::wide_block;

struct NamedLaw {
    const char* name;
    std::unique_ptr<ContactLaw> (*make)();
    bool has_many_points;
};

void PrintTo(const NamedLaw& law, std::ostream* out) {
    *out << law.name;
}

const NamedLaw laws[]{
    {"PointSpring", [] { return std::unique_ptr<ContactLaw>(std::make_unique<PointSpring>()); }, false},
    {"PetersikProbe", [] { return std::unique_ptr<ContactLaw>(std::make_unique<PetersikProbe>()); }, true},
    {"VoxelTool", [] { return std::unique_ptr<ContactLaw>(std::make_unique<VoxelTool>()); }, true},
    {"HertzContact", [] { return std::unique_ptr<ContactLaw>(std::make_unique<HertzContact>()); }, true}};

class EveryContactLaw : public ::testing::TestWithParam<NamedLaw> {
  protected:
    std::unique_ptr<ContactLaw> law = GetParam().make();
};

TEST_P(EveryContactLaw, FeelsNothingInAir) {
    ContactBench bench(wide_block());
    for (const double gap_mm : {0.06, 0.2, 0.5, 3.0, 100.0})
        EXPECT_EQ(bench.pressed(*law, -gap_mm).force_n, glm::dvec3(0.0)) << gap_mm << " mm above";
    EXPECT_EQ(bench.at(*law, {50.0, 0.0, 0.0}).force_n, glm::dvec3(0.0)) << "far beside";
}

TEST_P(EveryContactLaw, FeelsNothingWhereBoneIsGone) {
    Bone bone = wide_block();
    remove_where(bone, [](const glm::dvec3&) { return true; });
    ContactBench bench(std::move(bone));
    EXPECT_EQ(bench.pressed(*law, 0.5).force_n, glm::dvec3(0.0));
}

TEST_P(EveryContactLaw, PushesStraightOutOfAFlatFace) {
    ContactBench bench(wide_block());
    for (const double depth_mm : {0.1, 0.3, 0.5, 1.0}) {
        const glm::dvec3 force = bench.pressed(*law, depth_mm).force_n;
        EXPECT_GT(force.z, 0.0);
        EXPECT_LT(std::hypot(force.x, force.y) / force.z, 0.02) << depth_mm << " mm deep";
    }
    const glm::dvec3 aside = bench.at(*law, {2.6 + 2.5 - 0.5, 0.0, -1.1}).force_n;
    EXPECT_GT(aside.x, 0.99 * glm::length(aside)) << "out of the face at x = 2.6";
    EXPECT_GT(glm::length(aside), 0.1);
}

TEST_P(EveryContactLaw, GivesAboutANewtonAtHalfAMillimetreAsMillingDoes) {
    ContactBench bench(wide_block());
    EXPECT_NEAR(glm::length(bench.pressed(*law, 0.5).force_n), 1.05, 0.1);
}

TEST_P(EveryContactLaw, GrowsWithDepthWithoutAJump) {
    ContactBench bench(wide_block());
    constexpr double step_mm = 0.01;
    double before_n = 0.0;
    for (int i = -10; i <= 100; ++i) {
        const double force_n = glm::length(bench.pressed(*law, step_mm * i).force_n);
        EXPECT_GE(force_n, before_n - 1e-6) << step_mm * i << " mm deep";
        // The stiffest of them has 7.5 N/mm at 1 mm; a jump of a voxel would be 10 times this.
        EXPECT_LE(force_n - before_n, 0.1) << step_mm * i << " mm deep";
        before_n = force_n;
    }
}

TEST_P(EveryContactLaw, PushesWithTheSameWallWhetherTheSpindleTurnsOrNot) {
    ContactBench bench(wide_block());
    const glm::dvec3 off = bench.pressed(*law, 0.5, false).force_n;
    const glm::dvec3 on = bench.pressed(*law, 0.5, true).force_n;
    EXPECT_NEAR(on.z, off.z, 0.02 * off.z) << "friction at the tip has no direction";
}

TEST_P(EveryContactLaw, WearsBoneOnlyWhereItTouches) {
    ContactBench bench(wide_block());
    EXPECT_GT(bench.pressed(*law, 0.5, true).erosion_per_s, 1.0);
    EXPECT_EQ(bench.pressed(*law, -100.0, true).erosion_per_s, 0.0);
}

TEST_P(EveryContactLaw, BalancesTheWallsOfASlotIfItHasManyPoints) {
    Bone bone = wide_block();
    remove_where(bone, [](const glm::dvec3& p) { return std::abs(p.x) < 2.0; });
    ContactBench bench(std::move(bone));
    const auto sideways_n = [&](double x_mm) { return bench.at(*law, {x_mm, 0.0, 0.0}).force_n.x; };
    EXPECT_GT(sideways_n(-0.05), 0.05) << "the nearer wall pushes harder";
    EXPECT_LT(sideways_n(0.05), -0.05);
    const double jump_n = sideways_n(-0.002) - sideways_n(0.002);
    if (GetParam().has_many_points)
        EXPECT_LT(std::abs(jump_n), 0.25);
    else
        EXPECT_GT(jump_n, 2.0) << "one point knows one wall";
}

TEST_P(EveryContactLaw, FitsASmallBurr) {
    ContactBench bench(wide_block(), {.name = "1 mm", .diameter_mm = 1.0});
    const glm::dvec3 force = bench.pressed(*law, 0.2).force_n;
    EXPECT_GT(force.z, 0.03);
    EXPECT_LT(std::hypot(force.x, force.y), 0.05 * force.z);
}

TEST_P(EveryContactLaw, LosesItsDirectionWhollyWithinBone) {
    ContactBench bench(wide_block(), {.name = "1 mm", .diameter_mm = 1.0});
    // The sums cancel up to the lattice's error; at that depth in a flat face the force would be 0.3 N and
    // more.
    for (const glm::dvec3& position : {glm::dvec3(0.0, 0.0, -1.1), glm::dvec3(0.031, 0.017, -1.123)})
        EXPECT_LT(glm::length(bench.at(*law, position, true).force_n), 0.1);
}

INSTANTIATE_TEST_SUITE_P(ContactLaws, EveryContactLaw, ::testing::ValuesIn(laws),
                         [](const auto& named) { return named.param.name; });

}  // namespace
}  // namespace osteomill::contact_law_test
