#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report/structure_metrics.h"
#include "tests/support/ball_structure.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double exposed_spacing_mm = 0.1;

/// A cube of 6.4 mm from which the voxels that `is_cut` are removed; `structure` is the tissue of label 2, or
/// a mask.
std::vector<ExposureMetrics> exposures(const std::function<bool(const glm::dvec3&)>& is_nerve,
                                       const std::function<bool(const glm::dvec3&)>& is_cut,
                                       double ball_radius_mm = 0.0) {
    const testing::TemporaryFolder folder;
    const Bone bone = testing::labelled_cube(4, exposed_spacing_mm, [&](const glm::dvec3& at) {
        return static_cast<std::uint8_t>(is_nerve(at) ? 2 : 1);
    });
    std::vector<Structure> structures;
    if (ball_radius_mm > 0.0)
        structures.push_back({1, testing::ball_mask(bone.grid(), glm::dvec3(0.0), ball_radius_mm)});
    testing::WrittenSession written(
        folder / "a.pcap",
        {.scene_name = "cube",
         .burrs = {Burr{}},
         .tissues = {{.label = 1, .name = "bone"}, {.label = 2, .name = "nerve", .is_protected = true}}},
        bone, structures);
    written.frame({.time_s = 0.0, .burr_position_mm = {0.0, 0.0, 40.0}});
    written.cut(is_cut);
    written.frame({.time_s = 1.0, .burr_position_mm = {0.0, 0.0, 40.0}, .spindle_on = true});
    written.finish();
    return exposure_metrics(read_trace(folder / "a.pcap", [](double) {}));
}

bool nowhere(const glm::dvec3&) {
    return false;
}

TEST(ExposureMetricsTest, OfABallUnderAFlatFloorAreItsCaps) {
    // A plane g above a ball of radius r is nearer than d to a cap of height d - g, whose share of the ball
    // is (d - g) / 2r; and to no more than its upper half, since the rest faces away.
    const double r = 1.5;
    const double gap = 0.3;
    const auto found = exposures(
        nowhere, [&](const glm::dvec3& at) { return at.z > r + gap; }, r);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].name, "nerve");
    EXPECT_EQ(found[0].bare_share, 0.0);
    EXPECT_NEAR(found[0].thin_share[0], 0.2 / (2.0 * r), 0.02);
    EXPECT_NEAR(found[0].thin_share[1], 0.7 / (2.0 * r), 0.02);
    // Ways that graze the steep rim count for none, two voxels of it.
    EXPECT_LE(found[0].thin_share[2], 0.51);
    EXPECT_GE(found[0].thin_share[2], 0.42);
}

TEST(ExposureMetricsTest, OfAPlaneAreStepByStep) {
    // A nerve from z = 2 on. Under it everything is cut up to 2 (x below -1), to 1.7 (below 0) and to 1.2
    // (below 1): nothing, 0.3 and 0.8 mm are left. Beside a step the way to the deeper one is the shorter: a
    // floor 0.3 mm off is within 0.5 mm up to 0.4 mm beside it, one 0.8 mm off within 1 mm up to 0.6 mm.
    const auto is_cut = [](const glm::dvec3& at) {
        return at.z < (at.x < -1.0 ? 2.0 : at.x < 0.0 ? 1.7 : at.x < 1.0 ? 1.2 : -9.0);
    };
    const auto found = exposures([](const glm::dvec3& at) { return at.z > 2.0; }, is_cut);
    ASSERT_EQ(found.size(), 1u);
    const double column = exposed_spacing_mm / 6.4;
    EXPECT_NEAR(found[0].bare_share, 2.2 / 6.4, 0.1 * column);
    EXPECT_NEAR(found[0].thin_share[0], (3.2 + 0.4) / 6.4, 1.1 * column);
    EXPECT_NEAR(found[0].thin_share[1], (4.2 + 0.6) / 6.4, 1.1 * column);
}

TEST(ExposureMetricsTest, AreOfTheSideThatWasOpened) {
    // A sheet of 1 mm, opened from below: its other side is not exposed, though it is no 2 mm off.
    const auto is_sheet = [](const glm::dvec3& at) { return std::abs(at.z) < 0.5; };
    const auto found = exposures(is_sheet, [](const glm::dvec3& at) { return at.z < -0.8; });
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].thin_share[0], 0.5, 0.01);
    EXPECT_NEAR(found[0].thin_share[2], 0.5, 0.01);
    // Nothing is left over the milled part itself: half of both faces.
    const auto milled = exposures(is_sheet, [](const glm::dvec3& at) { return at.x < 0.0 && at.z < 0.5; });
    EXPECT_NEAR(milled[0].bare_share, 0.5, 0.02);
}

TEST(ExposureMetricsTest, AreNoneWhereNothingWasCut) {
    const auto found = exposures([](const glm::dvec3& at) { return at.z > 2.0; }, nowhere);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].thin_share[2], 0.0);
    EXPECT_TRUE(exposures(nowhere, nowhere).empty()) << "the nerve is nowhere";
}

}  // namespace
}  // namespace osteomill
