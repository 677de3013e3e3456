#include "simulation/force_models/milling_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "simulation/carving/sweep.h"
#include "tests/support/block.h"
#include "tests/support/bone_variants.h"

namespace osteomill::milling_model_test {
namespace {

using testing::make_block;

Bone block() {
    return make_block({-4.0, -3.0, -3.0}, {4.0, 3.0, 0.0}, 0.1);
}

BurrCommand at(const glm::dvec3& position, bool spindle_on) {
    return {.pose = {position, {0.0, 0.0, 1.0}}, .spindle_on = spindle_on, .burr = 0, .elapsed_s = 0.01};
}

class MillingModelTest : public ::testing::Test {
  protected:
    ForgottenChanges changes;
    std::unique_ptr<MillingResult> result = std::make_unique<MillingResult>();
    Burr burr{.name = "2 mm", .diameter_mm = 2.0};
};

TEST_F(MillingModelTest, ABurrAtRestDoesNotCut) {
    MillingModel model(block(), {burr}, {});
    const std::uint64_t before = checksum(model.bone());
    model.step(at({-1.0, 0.0, 0.5}, false), 0.0, changes, *result);
    model.step(at({1.0, 0.0, 0.5}, false), 0.01, changes, *result);
    EXPECT_EQ(checksum(model.bone()), before);
    EXPECT_EQ(result->force_n, glm::dvec3(0.0));
    EXPECT_GT(result->engagement.count, 0U) << "but it touches";
}

TEST_F(MillingModelTest, RemovesTheSweptVolumeAndAccountsForIt) {
    MillingModel model(make_block({-4.0, -3.0, -3.0}, {4.0, 3.0, 3.0}, 0.1), {burr}, {});
    const double before = bone_volume_mm3(model.bone());
    const glm::dvec3 from(-1.5, 0.02, 0.01);
    const glm::dvec3 to(1.5, 0.3, 0.2);
    for (int i = 0; i <= 300; ++i)
        model.step(at(from + (to - from) * (i / 300.0), true), 0.01 * i, changes, *result);
    const double swept = volume(Sweep{from, to, 1.0});
    EXPECT_NEAR(result->total_removed_mm3 / swept, 1.0, 0.005);
    EXPECT_NEAR(before - bone_volume_mm3(model.bone()), result->total_removed_mm3, 1e-6);
    EXPECT_NEAR(model.removed_mm3()[0], result->total_removed_mm3, 1e-9);
}

TEST_F(MillingModelTest, CountsNoBoneOfTheWayToANewBurr) {
    MillingModel model(block(), {burr, Burr{.name = "1 mm", .diameter_mm = 1.0}}, {});
    model.step(at({-2.0, 0.0, 3.0}, true), 0.0, changes, *result);
    BurrCommand other = at({2.0, 0.0, -1.0}, true);
    other.burr = 1;
    model.step(other, 0.01, changes, *result);
    EXPECT_NEAR(result->removed_mm3, 4.0 / 3.0 * 3.14159265 * 0.125, 0.01) << "one ball, no capsule";
}

TEST_F(MillingModelTest, SaysWhenProtectedTissueIsRemoved) {
    MillingModel model(testing::bone_over_nerve(), {Burr{.diameter_mm = 1.0}}, testing::bone_and_nerve());
    model.step(at({0.75, 0.75, 2.6}, true), 0.0, changes, *result);
    EXPECT_FALSE(result->touches_protected);
    EXPECT_GT(model.removed_mm3()[1], 0.0);
    model.step(at({0.75, 0.75, 1.6}, true), 0.1, changes, *result);
    EXPECT_TRUE(result->touches_protected);
    EXPECT_GT(model.removed_mm3()[2], 0.0);
}

TEST_F(MillingModelTest, ChipsAndTheirForceHalveAtTwiceTheSpeed) {
    const auto step_at = [&](double rev_per_s, double speed_share) {
        burr.spindle_rev_per_s = rev_per_s;
        MillingModel model(block(), {burr}, {});
        BurrCommand command = at({-1.0, 0.0, 0.5}, true);
        command.speed_share = speed_share;
        model.step(command, 0.0, changes, *result);
        command.pose.position_mm.x = -0.94;
        model.step(command, 0.01, changes, *result);
        return *result;
    };
    const auto own = std::make_unique<MillingResult>(step_at(100.0, 1.0));
    const auto twice = std::make_unique<MillingResult>(step_at(100.0, 2.0));
    EXPECT_NEAR(glm::length(twice->force_n) / glm::length(own->force_n), 0.5, 1e-6);
    EXPECT_EQ(twice->removed_mm3, own->removed_mm3);
    const auto faster_burr = std::make_unique<MillingResult>(step_at(200.0, 1.0));
    EXPECT_EQ(twice->force_n, faster_burr->force_n);
    ASSERT_EQ(twice->engagement.count, faster_burr->engagement.count);
    for (std::size_t i = 0; i < twice->engagement.count; ++i)
        EXPECT_EQ(twice->engagement.patches[i].cutting_n_s_per_mm,
                  faster_burr->engagement.patches[i].cutting_n_s_per_mm);
}

TEST_F(MillingModelTest, RefusesASpeedThatIsNone) {
    MillingModel model(block(), {burr}, {});
    for (const double share : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        BurrCommand command = at({-1.0, 0.0, 0.5}, true);
        command.speed_share = share;
        model.step(command, 0.0, changes, *result);
        EXPECT_FALSE(result->valid);
    }
}

TEST_F(MillingModelTest, StifferBoneNeedsProportionallyMoreForce) {
    const auto force_in = [&](double stiffness) {
        MillingModel model(testing::with_stiffness(block(), stiffness), {burr}, {});
        model.step(at({-1.0, 0.0, 0.5}, true), 0.0, changes, *result);
        model.step(at({-0.94, 0.0, 0.5}, true), 0.01, changes, *result);
        return result->force_n;
    };
    const glm::dvec3 one = force_in(1.0);
    EXPECT_GT(glm::length(one), 0.1);
    EXPECT_NEAR(glm::length(force_in(0.25) - 0.25 * one), 0.0, 1e-12);
}

TEST_F(MillingModelTest, LeavesTheBoneAloneOnACommandThatIsNoPose) {
    MillingModel model(block(), {burr}, {});
    model.step(at({-1.0, 0.0, 0.5}, true), 0.0, changes, *result);
    const std::uint64_t before = checksum(model.bone());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BurrCommand bad_axis = at({1.0, 0.0, 0.5}, true);
    bad_axis.pose.spindle_axis = {0.0, 0.0, 0.0};
    BurrCommand no_burr = at({1.0, 0.0, 0.5}, true);
    no_burr.burr = 1;
    BurrCommand no_time = at({1.0, 0.0, 0.5}, true);
    no_time.elapsed_s = 0.0;
    for (const BurrCommand& bad : {at({nan, 0.0, 0.5}, true), bad_axis, no_burr, no_time}) {
        model.step(bad, 0.01, changes, *result);
        EXPECT_FALSE(result->valid);
        EXPECT_EQ(result->force_n, glm::dvec3(0.0));
        EXPECT_EQ(checksum(model.bone()), before);
    }
    model.step(at({-0.9, 0.0, 0.5}, true), 0.02, changes, *result);
    EXPECT_TRUE(result->valid);
}

TEST_F(MillingModelTest, RefusesABurrThatCannotCut) {
    EXPECT_THROW(MillingModel(block(), {}, {}), std::invalid_argument);
    EXPECT_THROW(MillingModel(block(), {Burr{.diameter_mm = 0.0}}, {}), std::invalid_argument);
    EXPECT_THROW(MillingModel(block(), {Burr{.spindle_rev_per_s = -1.0}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::milling_model_test
