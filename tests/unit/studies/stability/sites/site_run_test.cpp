#include "studies/stability/sites/site_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "studies/stability/sites/named_sites.h"
#include "studies/stability/sites/site.h"
#include "studies/stability/sites/site_verdict.h"

namespace osteomill::study::site_run_test {
namespace {

Site site_called(const std::string& name) {
    for (Site& site : named_sites({.diameter_mm = 5.0}))
        if (site.name == name) return std::move(site);
    ADD_FAILURE() << name;
    return {};
}

TEST(SiteBone, IsFullInsideHalfAtTheSurfaceAndAirOutside) {
    const SiteShape shape{.distance_mm = [](const glm::dvec3& p) { return p.z; },
                          .low_mm = {-1.0, -1.0, -1.0},
                          .high_mm = {1.0, 1.0, 1.05},
                          .relative_stiffness = [](const glm::dvec3& p) { return p.x < 0.0 ? 1.0 : 0.3; }};
    const Bone bone = site_bone(shape);
    EXPECT_EQ(bone.fraction_at({5, 5, 5}), 255);
    EXPECT_EQ(bone.fraction_at({5, 5, 9}), 255);
    EXPECT_EQ(bone.fraction_at({5, 5, 10}), 0);
}

TEST(SiteRun, CutsAndFeelsWhatTheModelSays) {
    const Site site = site_called("inside the edge, along -x");
    const SiteRun run = run_site(site, {});
    double model_n = 0.0;
    for (const SiteTick& tick : run.ticks) model_n = std::max(model_n, glm::length(tick.model_n));
    EXPECT_GT(model_n, 0.3);
    const SiteVerdict verdict = verdict_on(run);
    EXPECT_LT(verdict.error_percent, 8.0);
    EXPECT_LT(verdict.stuck_ms, 50.0);
    EXPECT_LT(verdict.largest_jump_n, 0.3);
    EXPECT_EQ(run.faults, 0U);
    EXPECT_LT(run.solve.max_residual_n, 1e-3);
}

TEST(SiteRun, GivesTheHandNoMoreEnergyThanARigidBurrWould) {
    for (const char* name :
         {"plate of 1 mm tilted by 15", "inside the edge, along +x", "there and back in a slot"}) {
        const SiteRun run = run_site(site_called(name), {});
        EXPECT_LT(verdict_on(run).energy_over_rigid_mj, 5.0) << name;
        EXPECT_LT(run.solve.max_residual_n, 1e-3) << name;
    }
}

}  // namespace
}  // namespace osteomill::study::site_run_test
