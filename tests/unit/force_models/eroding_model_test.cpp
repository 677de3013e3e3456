#include "simulation/force_models/eroding_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "simulation/force_models/force_models.h"
#include "simulation/force_models/voxel_tool.h"
#include "tests/support/block.h"
#include "tests/support/bone_variants.h"

namespace osteomill::eroding_model_test {
namespace {

using testing::make_block;

const Burr two_mm{.name = "2 mm", .diameter_mm = 2.0};

Bone block() {
    return make_block({-2.4, -1.6, -1.6}, {2.4, 1.6, 0.0}, 0.1);
}

BurrCommand at(const glm::dvec3& position, bool spindle_on, double elapsed_s = 0.001) {
    return {.pose = {position, {0.0, 0.0, 1.0}}, .spindle_on = spindle_on, .burr = 0, .elapsed_s = elapsed_s};
}

std::vector<std::string> eroding_models() {
    std::vector<std::string> names;
    for (const ForceModelEntry& model : force_models())
        if (!model.has_cutting_law) names.push_back(model.name);
    return names;
}

class EveryErodingModel : public ::testing::TestWithParam<std::string> {
  protected:
    std::unique_ptr<ForceModel> make(Bone bone = block(), const std::vector<Tissue>& tissues = {}) const {
        return make_force_model(GetParam(), std::move(bone), {two_mm, {.name = "1 mm", .diameter_mm = 1.0}},
                                tissues);
    }
    void step(ForceModel& model, const BurrCommand& command) { model.step(command, 0.0, changes, *result); }

    /// The volume that a pass through the block removes, in that many steps a second, mm^3.
    double removed_by_a_pass(double rate_hz) {
        const auto model = make();
        const auto steps = static_cast<int>(0.3 * rate_hz);
        step(*model, at({-0.9, 0.013, 0.7}, false));
        for (int i = 1; i <= steps; ++i)
            step(*model, at({-0.9 + 6.0 * i / rate_hz, 0.013, 0.7}, true, 1.0 / rate_hz));
        return result->total_removed_mm3;
    }

    ForgottenChanges changes;
    std::unique_ptr<MillingResult> result = std::make_unique<MillingResult>();
};

TEST_P(EveryErodingModel, IsAWallWhileTheSpindleRests) {
    const auto model = make();
    step(*model, at({0.0, 0.0, 0.7}, false));
    step(*model, at({0.3, 0.0, 0.7}, false));
    EXPECT_EQ(checksum(model->bone()), checksum(block()));
    EXPECT_GT(result->force_n.z, 0.05);
    EXPECT_EQ(result->engagement.count, 0u) << "nothing for a coupling to solve";
    EXPECT_EQ(result->removed_mm3, 0.0);
}

TEST_P(EveryErodingModel, FeelsTheBoneAsItWasBeforeTheStep) {
    const auto resting = make();
    step(*resting, at({0.0, 0.0, 0.7}, false));
    const double wall_n = result->force_n.z;
    const auto turning = make();
    step(*turning, at({0.0, 0.0, 0.7}, true, 0.04));
    EXPECT_NEAR(result->force_n.z, wall_n, 0.02 * wall_n);
    step(*turning, at({0.0, 0.0, 0.7}, true, 0.04));
    EXPECT_LT(result->force_n.z, 0.9 * wall_n) << "and the next the bone that is left";
}

TEST_P(EveryErodingModel, AccountsForWhatItRemoves) {
    const auto model = make();
    const double before = bone_volume_mm3(model->bone());
    double sum = 0.0;
    for (int i = 0; i < 200; ++i) {
        step(*model, at({-0.6 + 0.006 * i, 0.0, 0.6}, true));
        sum += result->removed_mm3;
    }
    EXPECT_GT(sum, 0.01);
    EXPECT_NEAR(before - bone_volume_mm3(model->bone()), sum, 1e-9);
    EXPECT_NEAR(result->total_removed_mm3, sum, 1e-9);
    EXPECT_NEAR(model->removed_mm3()[0], sum, 1e-9);
}

TEST_P(EveryErodingModel, RemovesTheSameAtEveryRateOfSteps) {
    const double coarse = removed_by_a_pass(100.0);
    const double usual = removed_by_a_pass(1000.0);
    const double fine = removed_by_a_pass(10000.0);
    EXPECT_GT(fine, 0.1);
    // Agus's rate follows the bone that is left, and changes much within 10 ms.
    EXPECT_NEAR(coarse / fine, 1.0, GetParam() == "agus" ? 0.04 : 0.01);
    EXPECT_NEAR(usual / fine, 1.0, 0.01);
}

TEST_P(EveryErodingModel, SaysWhenProtectedTissueGoes) {
    const auto model = make(testing::bone_over_nerve(), testing::bone_and_nerve());
    step(*model, at({0.75, 0.75, 3.9}, true, 0.02));
    EXPECT_FALSE(result->touches_protected);
    EXPECT_GT(model->removed_mm3()[1], 0.0);
    for (int i = 0; i < 100 && !result->touches_protected; ++i)
        step(*model, at({0.75, 0.75, 3.9 - 0.03 * i}, true, 0.02));
    EXPECT_TRUE(result->touches_protected);
    EXPECT_GT(model->removed_mm3()[2], 0.0);
}

TEST_P(EveryErodingModel, RemovesNothingOnTheWayToAnotherBurr) {
    const auto model = make();
    step(*model, at({-2.0, 0.0, 2.0}, true));
    BurrCommand other = at({1.0, 0.0, 2.0}, true);
    other.burr = 1;
    step(*model, other);
    EXPECT_EQ(result->total_removed_mm3, 0.0);
    EXPECT_EQ(result->burr, 1u);
}

TEST_P(EveryErodingModel, LeavesTheBoneAloneOnACommandThatIsNoPose) {
    const auto model = make();
    step(*model, at({0.0, 0.0, 0.7}, true));
    const std::uint64_t before = checksum(model->bone());
    BurrCommand bad_axis = at({0.1, 0.0, 0.7}, true);
    bad_axis.pose.spindle_axis = {0.0, 0.0, 0.0};
    BurrCommand no_burr = at({0.1, 0.0, 0.7}, true);
    no_burr.burr = 2;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const BurrCommand& bad :
         {at({nan, 0.0, 0.7}, true), bad_axis, no_burr, at({0.1, 0.0, 0.7}, true, 0.0)}) {
        step(*model, bad);
        EXPECT_FALSE(result->valid);
        EXPECT_EQ(result->force_n, glm::dvec3(0.0));
        EXPECT_EQ(checksum(model->bone()), before);
    }
    step(*model, at({0.1, 0.0, 0.7}, true));
    EXPECT_TRUE(result->valid);
}

TEST_P(EveryErodingModel, FeelsNothingWhereThereIsNoGrid) {
    const auto model = make();
    step(*model, at({1e9, 0.0, 0.0}, true));
    EXPECT_TRUE(result->valid);
    EXPECT_EQ(result->force_n, glm::dvec3(0.0));
}

INSTANTIATE_TEST_SUITE_P(ErodingModels, EveryErodingModel, ::testing::ValuesIn(eroding_models()),
                         [](const auto& named) {
                             std::string name = named.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(ErodingModel, LeavesCoveredBoneFiftyMilliseconds) {
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    ErodingModel model(block(), {two_mm}, {}, std::make_unique<VoxelTool>());
    for (int i = 0; i < 49; ++i) model.step(at({0.0, 0.0, 0.5}, true), 0.0, changes, *result);
    EXPECT_GT(result->force_n.z, 0.0);
    for (int i = 0; i < 2; ++i) model.step(at({0.0, 0.0, 0.5}, true), 0.0, changes, *result);
    EXPECT_EQ(model.bone().fraction_at(
                  glm::ivec3(to_voxel_coordinates(model.bone().grid(), {0.05, 0.05, -0.05}) + 0.5)),
              0);
}

}  // namespace
}  // namespace osteomill::eroding_model_test
