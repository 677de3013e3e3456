#include "simulation/carving/full_scan.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <stdexcept>

#include "simulation/force_models/force_models.h"
#include "studies/force/bone_block.h"
#include "studies/force/studied_model.h"

namespace osteomill::study {
namespace {

const Burr burr{.diameter_mm = 1.5, .sense = SpindleSense::clockwise};

Bone layered_block() {
    return voxelised({.low_mm = {-2.0, -1.6, -1.8},
                      .high_mm = {2.0, 1.6, 0.4},
                      .up = glm::normalize(glm::dvec3(0.1, 0.2, 1.0)),
                      .layer = TopLayer{.thickness_mm = 0.5, .stiffness = 0.4}},
                     0.1);
}

MakeModel full_scan_model(MillingSettings settings) {
    settings.search = VoxelSearch::full_scan;
    return voxel_model(settings);
}

/// Both models along a path that turns, dives, leaves the block and makes a long leap.
void expect_equal(const MillingSettings& settings) {
    const auto crescent = voxel_model(settings)(layered_block(), burr);
    const auto scan = full_scan_model(settings)(layered_block(), burr);
    const std::uint64_t untouched = checksum(scan->bone());
    glm::dvec3 place(-1.3, -0.7, 0.45);
    double total_n = 0.0;
    constexpr int leap = 55;
    for (int i = 0; i < 60; ++i) {
        if (i == leap) place += glm::dvec3(0.4, -0.6, 0.1);
        place += 0.06 * glm::normalize(glm::dvec3(1.0, 0.04 * i, i < 20 ? -0.5 : 0.2));
        const BurrCommand command{.pose = {place, glm::normalize(glm::dvec3(0.3, -0.2, 1.0))},
                                  .spindle_on = i != 10,
                                  .burr = 0,
                                  .elapsed_s = 0.01};
        const StepOutcome a = crescent->step(command);
        const StepOutcome b = scan->step(command);
        ASSERT_EQ(checksum(crescent->bone()), checksum(scan->bone())) << "step " << i;
        EXPECT_NEAR(a.removed_mm3, b.removed_mm3, 1e-9) << "step " << i;
        EXPECT_LT(glm::length(a.force_n - b.force_n), 1e-4 * glm::length(b.force_n) + 1e-9) << "step " << i;
        total_n += glm::length(b.force_n);
    }
    EXPECT_NE(checksum(scan->bone()), untouched);
    EXPECT_GT(total_n, 1.0);
}

TEST(FullScan, LeavesTheSameBoneAndFeelsTheSameForceAsTheCrescent) {
    expect_equal({});
    expect_equal({.coverage = VoxelCoverage::linear});
    expect_equal({.coverage = VoxelCoverage::binary});
    expect_equal({.summation = ForceSummation::bins});
    expect_equal({.summation = ForceSummation::bins, .coverage = VoxelCoverage::binary});
}

TEST(FullScan, VisitsTheVoxelsOfTheBurr) {
    // 4/3 pi 25^3 = 65 450, less or more by a share of the surface's voxels.
    EXPECT_NEAR(static_cast<double>(FullScan(25.0, VoxelCoverage::binary).voxel_count()), 65'450.0, 400.0);
}

/// Keeps a copy of the bone by the changes alone.
class Copy final : public ChangeSink {
  public:
    explicit Copy(Bone bone) : bone_(std::move(bone)) {}
    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        is_true_ = is_true_ && change.voxels.any() && apply(change, fractions, bone_);
        ++pushed_[change.brick];
    }
    const Bone& bone() const { return bone_; }
    bool is_true() const { return is_true_; }
    /// How often the brick was pushed that was pushed most; starts to count anew.
    int most_pushed() {
        int most = 0;
        for (const auto& [brick, count] : pushed_) most = std::max(most, count);
        pushed_.clear();
        return most;
    }

  private:
    Bone bone_;
    bool is_true_ = true;
    std::map<BrickIndex, int> pushed_;
};

TEST(FullScan, ReportsWhatItChangesEachBrickOnce) {
    const auto model = make_force_model("milling-scan", layered_block(), {burr}, {});
    Copy copy(layered_block());
    const auto result = std::make_unique<MillingResult>();
    for (int i = 0; i < 30; ++i) {
        const BurrCommand command{.pose = {{-1.3 + 0.08 * i, 0.01 * i, 0.3}, {0.0, 0.0, 1.0}},
                                  .spindle_on = true,
                                  .elapsed_s = 0.01};
        model->step(command, 0.0, copy, *result);
        EXPECT_LE(copy.most_pushed(), 1) << "step " << i;
    }
    EXPECT_TRUE(copy.is_true());
    EXPECT_EQ(checksum(copy.bone()), checksum(model->bone()));
    EXPECT_NE(checksum(copy.bone()), checksum(layered_block()));
}

TEST(FullScan, TakesBallsOfUpToTwoHundredVoxels) {
    const auto make = [](const Burr& its_burr) {
        (void)make_force_model("milling-scan", layered_block(), {its_burr}, {});
    };
    EXPECT_THROW(make({.diameter_mm = 20.2}), std::invalid_argument);
    EXPECT_THROW(make({.diameter_mm = 2.0, .head = usual_head(HeadShape::cylinder, 2.0, 4.0)}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study
