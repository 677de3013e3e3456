#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "analysis/report/structure_metrics.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double near_frame_s = 0.05;
constexpr double burr_radius_mm = 0.5;
constexpr double nerve_mm = 2.0;  // from z = 2 on upwards

/// A cube of 6.4 mm whose upper part is a nerve; a hand that cuts a voxel of its floor in each frame.
class NearANerve : public ::testing::Test {
  protected:
    NearANerve()
        : written_(folder_ / "a.pcap",
                   {.scene_name = "cube",
                    .burrs = {Burr{.diameter_mm = 2.0 * burr_radius_mm}},
                    .tissues = {{.label = 1, .name = "bone"},
                                {.label = 2, .name = "nerve", .is_protected = true}}},
                   testing::labelled_cube(2, 0.2, [](const glm::dvec3& at) {
                       return static_cast<std::uint8_t>(at.z > nerve_mm ? 2 : 1);
                   })) {
        place({0.0, 0.0, -2.9});
    }
    /// From there on, without a frame that cuts.
    void place(const glm::dvec3& burr_mm) {
        tool_.spindle_on = false;
        tool_.burr_position_mm = burr_mm;
        written_.frame(tool_);
        tool_.time_s += near_frame_s;
    }
    /// Cuts on the way, straight and at constant speed.
    void cut_by(const glm::dvec3& way_mm, int frames, double force_n) {
        tool_.spindle_on = true;
        tool_.force_n = {0.0, 0.0, force_n};
        for (int i = 0; i < frames; ++i) {
            const glm::dvec3 voxel(-3.1 + 0.2 * (cuts_ % 32), -3.1 + 0.2 * (cuts_ / 32), -3.1);
            ++cuts_;
            written_.cut([&](const glm::dvec3& at) { return glm::length(at - voxel) < 0.05; });
            tool_.burr_position_mm += way_mm / static_cast<double>(frames);
            written_.frame(tool_);
            tool_.time_s += near_frame_s;
        }
    }
    NearnessMetrics metrics() {
        written_.finish();
        return nearness_metrics(read_trace(folder_ / "a.pcap", [](double) {}));
    }
    /// Place of the burr's centre at a distance from the nerve.
    static double height_mm(double distance_mm) { return nerve_mm - burr_radius_mm - distance_mm; }

    testing::TemporaryFolder folder_;
    testing::WrittenSession written_;
    ToolState tool_{};
    int cuts_ = 0;
};

TEST_F(NearANerve, ForceAndFeedAreThoseOfEachDistance) {
    const auto at = [&](double distance_mm, double length_mm, int frames, double force_n) {
        place({-2.0, 0.0, height_mm(distance_mm)});
        cut_by({length_mm, 0.0, 0.0}, frames, force_n);
    };
    at(3.3, 4.0, 20, 2.0);  // 4 mm/s
    at(2.5, 3.0, 20, 1.5);  // 3 mm/s
    at(1.5, 2.0, 40, 1.0);  // 1 mm/s
    at(0.5, 1.0, 40, 0.4);  // 0.5 mm/s
    const NearnessMetrics near = metrics();
    EXPECT_NEAR(near.elsewhere.time_s, 1.0, 1e-9);
    EXPECT_NEAR(*near.elsewhere.force_n, 2.0, 1e-9);
    EXPECT_NEAR(*near.elsewhere.feed_mm_per_s, 4.0, 1e-9);
    ASSERT_EQ(near.structures.size(), 1u);
    EXPECT_EQ(near.structures[0].name, "nerve");
    const auto& within = near.structures[0].within;
    const auto expect = [](const ForceAndFeed& one, double time_s, double force_n_s, double path_mm) {
        EXPECT_NEAR(one.time_s, time_s, 1e-9);
        EXPECT_NEAR(*one.force_n, force_n_s / time_s, 1e-9);
        EXPECT_NEAR(*one.feed_mm_per_s, path_mm / time_s, 1e-9);
    };
    expect(within[0], 2.0, 0.8, 1.0);
    expect(within[1], 4.0, 0.8 + 2.0, 1.0 + 2.0);
    expect(within[2], 5.0, 0.8 + 2.0 + 1.5, 1.0 + 2.0 + 3.0);
}

TEST_F(NearANerve, StrokesLeadWhereTheirSlopeSays) {
    // The border is at 45 degrees to the nerve's plane.
    const auto slope = [&](double up_deg, double length_mm, double from_mm) {
        place({-1.5, 0.0, height_mm(from_mm)});
        cut_by({length_mm * std::cos(glm::radians(up_deg)), 0.0, length_mm * std::sin(glm::radians(up_deg))},
               20, 1.0);
    };
    slope(90.0, 2.0, 2.8);   // toward
    slope(50.0, 1.0, 2.0);   // toward
    slope(40.0, 1.0, 2.0);   // along
    slope(0.0, 3.0, 1.0);    // along
    slope(-20.0, 1.0, 1.0);  // along
    slope(-70.0, 2.0, 0.5);  // away
    slope(90.0, 0.4, 2.0);   // too short to tell
    const NearnessMetrics near = metrics();
    ASSERT_EQ(near.structures.size(), 1u);
    const NearStructure& nerve = near.structures[0];
    EXPECT_NEAR(nerve.toward_mm, 3.0, 1e-6);
    EXPECT_NEAR(nerve.along_mm, 5.0, 1e-6);
    EXPECT_NEAR(nerve.away_mm, 2.0, 1e-6);
    EXPECT_NEAR(*nerve.toward_share(), 0.3, 1e-6);
}

TEST_F(NearANerve, IsOfNobodyWhereNothingWasCutNearby) {
    place({0.0, 0.0, height_mm(0.5)});
    place({0.0, 0.0, height_mm(4.0)});
    cut_by({1.0, 0.0, 0.0}, 10, 1.0);
    const NearnessMetrics near = metrics();
    EXPECT_TRUE(near.structures.empty());
    EXPECT_NEAR(near.elsewhere.time_s, 0.5, 1e-9);
}

}  // namespace
}  // namespace osteomill
