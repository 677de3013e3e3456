#include "analysis/report/plan_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double fine_mm = 0.1;
constexpr double radius_mm = 1.5;

bool is_in_sphere(const glm::dvec3& place, const glm::dvec3& centre) {
    return glm::length(place - centre) <= radius_mm;
}

/// A sphere about `cut_centre` is cut out of a cube of 4.8 mm whose own sphere (tissue 2) is about the
/// origin.
PlanMetrics metrics_of(const Plan& plan, const glm::dvec3& cut_centre) {
    const testing::TemporaryFolder folder;
    const Bone bone = testing::labelled_cube(3, fine_mm, [](const glm::dvec3& place) {
        return static_cast<std::uint8_t>(is_in_sphere(place, glm::dvec3(0.0)) ? 2 : 1);
    });
    testing::WrittenSession written(
        folder / "a.pcap",
        {.scene_name = "cube",
         .burrs = {Burr{.name = "small"}},
         .tissues = {{.label = 1, .name = "bone"}, {.label = 2, .name = "lesion"}},
         .force_limit_n = 3.3,
         .plan = plan},
        bone);
    written.frame({.time_s = 0.0});
    written.cut([&](const glm::dvec3& place) { return is_in_sphere(place, cut_centre); });
    written.frame({.time_s = 1.0, .spindle_on = true});
    written.finish();
    return plan_metrics(read_trace(folder / "a.pcap", [](double) {})).value();
}

constexpr double sphere_mm3 = 4.0 / 3.0 * 3.14159265358979 * radius_mm * radius_mm * radius_mm;

TEST(PlanMetricsTest, OfACutThatIsThePlanAreWithoutFault) {
    for (const Plan& plan :
         {Plan{.region = SphereRegion{glm::dvec3(0.0), radius_mm}}, Plan{.region = TissueRegion{"lesion"}}}) {
        const PlanMetrics metrics = metrics_of(plan, glm::dvec3(0.0));
        EXPECT_NEAR(metrics.planned_mm3, sphere_mm3, 0.02 * sphere_mm3);
        EXPECT_EQ(metrics.removed_share, 1.0);
        EXPECT_EQ(metrics.outside_mm3, 0.0);
        EXPECT_EQ(metrics.excess_mm3, 0.0);
        ASSERT_TRUE(metrics.surface);
        EXPECT_EQ(metrics.surface->mean_mm, 0.0);
        EXPECT_EQ(metrics.surface->hausdorff_mm, 0.0);
    }
}

TEST(PlanMetricsTest, OfAShiftedSphereAreThoseOfTwoSpheres) {
    // Two spheres a distance d apart share a lens; their surfaces differ by d |cos|, d / 2 in the mean.
    const double d = 0.6;
    const double shared_mm3 =
        3.14159265358979 / 12.0 * (4.0 * radius_mm + d) * (2.0 * radius_mm - d) * (2.0 * radius_mm - d);
    for (const Plan& plan : {Plan{.region = SphereRegion{glm::dvec3(0.0), radius_mm}, .margin_mm = 0.25},
                             Plan{.region = TissueRegion{"lesion"}, .margin_mm = 0.25}}) {
        const PlanMetrics metrics = metrics_of(plan, {d, 0.0, 0.0});
        EXPECT_NEAR(metrics.removed_share, shared_mm3 / sphere_mm3, 0.01);
        EXPECT_NEAR(metrics.outside_mm3, sphere_mm3 - shared_mm3, 0.02 * sphere_mm3);
        ASSERT_TRUE(metrics.surface);
        EXPECT_NEAR(metrics.surface->mean_mm, 0.5 * d, fine_mm / 2);
        EXPECT_NEAR(metrics.surface->p95_mm, 0.95 * d, fine_mm);
        EXPECT_NEAR(metrics.surface->hausdorff_mm, d, fine_mm);
        EXPECT_GT(metrics.excess_mm3, 0.0);
        EXPECT_LT(metrics.excess_mm3, metrics.outside_mm3);
    }
    // All that is outside of the sphere is beyond no margin, and within one of the whole shift.
    const PlanMetrics none =
        metrics_of({.region = SphereRegion{glm::dvec3(0.0), radius_mm}, .margin_mm = 0.0}, {d, 0.0, 0.0});
    EXPECT_NEAR(none.excess_mm3, none.outside_mm3, 1e-9);
    const PlanMetrics all =
        metrics_of({.region = SphereRegion{glm::dvec3(0.0), radius_mm}, .margin_mm = d}, {d, 0.0, 0.0});
    EXPECT_EQ(all.excess_mm3, 0.0);
}

TEST(PlanMetricsTest, OfACylinderKnowItsFlatEnds) {
    const double length_mm = 1.6;
    const Plan plan{.region = CylinderRegion{{0, 0, -0.5 * length_mm}, {0, 0, 0.5 * length_mm}, radius_mm},
                    .margin_mm = 0.0};
    const PlanMetrics metrics = metrics_of(plan, glm::dvec3(0.0));
    EXPECT_NEAR(metrics.planned_mm3, 3.14159265358979 * radius_mm * radius_mm * length_mm, 0.15);
    const double half = 0.5 * length_mm;
    const double zone_mm3 =
        2.0 * 3.14159265358979 * (radius_mm * radius_mm * half - half * half * half / 3.0);
    EXPECT_NEAR(metrics.removed_mm3, zone_mm3, 0.02 * zone_mm3);
    EXPECT_NEAR(metrics.excess_mm3, sphere_mm3 - zone_mm3, 0.03 * sphere_mm3);
}

TEST(PlanMetricsTest, OfNothingRemovedHaveNoSurface) {
    const PlanMetrics metrics = metrics_of({.region = TissueRegion{"lesion"}}, glm::dvec3(100.0, 0.0, 0.0));
    EXPECT_EQ(metrics.removed_share, 0.0);
    EXPECT_FALSE(metrics.surface);
    const PlanMetrics unknown = metrics_of({.region = TissueRegion{"what nobody knows"}}, glm::dvec3(0.0));
    EXPECT_EQ(unknown.planned_mm3, 0.0);
    EXPECT_EQ(unknown.removed_share, 0.0);
    EXPECT_NEAR(unknown.excess_mm3, sphere_mm3, 0.02 * sphere_mm3);
}

}  // namespace
}  // namespace osteomill
