#include "studies/stability/map/map_points.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "simulation/cutting_force/reference_force.h"
#include "studies/stability/map/map_text.h"

namespace osteomill::study::map_points_test {
namespace {

/// Of a burr on its way through flat bone, N s/m.
double resistance(const CuttingCondition& condition) {
    SteadyMotion motion;
    motion.burr.diameter_mm = 5.0;
    motion.burr.spindle_rev_per_s = condition.spindle_rpm / 60.0;
    motion.position_mm = {0.0, 0.0, 0.5 * motion.burr.diameter_mm - condition.depth_mm};
    motion.velocity_mm_per_s = {1.0, 0.0, 0.0};
    const glm::dvec3 force_n = mean_reference_force_n(
        motion, [&](const glm::dvec3& p) { return p.z < 0.0 ? condition.relative_stiffness : 0.0; },
        {.kappa = 60, .psi = 120});
    return 1000.0 * glm::length(force_n);
}

TEST(MapPoints, SpanTheResistanceThatASurgeonMeetsInEvenSteps) {
    std::vector<double> resistances;
    for (const CuttingCondition& condition : cutting_conditions(false))
        resistances.push_back(resistance(condition));
    EXPECT_LT(resistances.front(), 6.0);
    EXPECT_GT(resistances.back(), 3400.0);
    for (std::size_t i = 1; i < resistances.size(); ++i) {
        EXPECT_GT(resistances[i] / resistances[i - 1], 1.2) << i;
        EXPECT_LT(resistances[i] / resistances[i - 1], 1.5) << i;
    }
}

TEST(MapPoints, AreEachOnTheListOnce) {
    const auto points = map_points({});
    std::set<std::string> seen;
    for (const MapPoint& point : points) EXPECT_TRUE(seen.insert(text_of(point)).second);
    EXPECT_EQ(std::count_if(points.begin(), points.end(),
                            [](const MapPoint& p) { return p.part == MapPart::bars; }),
              5 * 4 * 3 * 3 * 2);
}

TEST(MapPoints, AreThoseThatAreSelected) {
    const MapSelection selection{
        .quick = true, .methods = {"hold"}, .grips = {MapGrip::firm}, .delays_ticks = {1}};
    const auto points = map_points(selection);
    ASSERT_FALSE(points.empty());
    const auto all = map_points({.quick = true});
    const auto wanted = std::count_if(all.begin(), all.end(), [](const MapPoint& p) {
        return p.run.method == "hold" && p.run.grip == MapGrip::firm && p.run.delay_ticks == 1;
    });
    EXPECT_EQ(points.size(), static_cast<std::size_t>(wanted));
}

TEST(MapPoints, WithEdgesThatRubCutWhereAHandGetsOn) {
    const auto points = map_points({.has_edge_forces = true, .methods = {"implicit"}});
    const auto without = map_points({.methods = {"implicit"}});
    EXPECT_GT(points.size(), without.size() / 8);
    EXPECT_LT(points.size(), without.size());
    for (const MapPoint& point : points) {
        EXPECT_EQ(point.run.scene, MapScene::cutting);
        EXPECT_EQ(point.run.edge_n_per_mm, 0.3);
        EXPECT_LT(point.run.depth_mm, 1.0) << "deeper the edges alone take all that a hand gives";
    }
}

}  // namespace
}  // namespace osteomill::study::map_points_test
