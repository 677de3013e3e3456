// unrounded_loss.h, which is for vector units only, as a carve and the milling model use it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptic_server/milling/carve.h"
#include "haptic_server/milling/milling_model.h"
#include "tests/support/block.h"
#include "tests/support/smoothed_ramp.h"

namespace osteomill {
namespace {

using testing::NoEdits;

constexpr double voxel_mm = 0.1;

/// Adds up what a carve says, in steps of 255.
class Losses final : public RemovalSink {
  public:
    void take(const RemovedVoxels& removed) noexcept override { whole_steps += removed.lost_codes(); }
    bool wants_unrounded() const noexcept override { return true; }
    void take_unrounded(const RemovedVoxels& more) noexcept override {
        EXPECT_EQ(more.bone, nullptr);
        for (std::size_t i = 0; i < more.count; ++i) {
            beyond_steps += static_cast<double>(more.codes[i]);
            largest = std::max(largest, std::abs(static_cast<double>(more.codes[i])));
        }
    }

    double whole_steps = 0.0;
    double beyond_steps = 0.0;
    double largest = 0.0;
};

/// What is left of a soft voxel, steps of 255.
double ramp(double beyond_voxels) {
    return 255.0 * testing::left_by_ramp(beyond_voxels, smoothing_voxels(VoxelEdges::soft));
}

/// Of a ball of `radius` voxels that goes from `from` to `to`, straight, through whole bone.
double loss_of_whole_bone(const glm::dvec3& from, const glm::dvec3& to, double radius) {
    const glm::ivec3 low(glm::floor(glm::min(from, to) - radius - 1.0));
    const glm::ivec3 high(glm::ceil(glm::max(from, to) + radius + 1.0));
    const glm::dvec3 along = to - from;
    double loss = 0.0;
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                const glm::dvec3 w = glm::dvec3(x, y, z) - from;
                const double t = std::clamp(glm::dot(w, along) / glm::dot(along, along), 0.0, 1.0);
                const double before = glm::length(w) - radius;
                const double after = glm::length(w - t * along) - radius;
                if (after < 1.0 && before > -1.0) loss += ramp(before) - ramp(after);
            }
    return loss;
}

TEST(UnroundedLoss, IsWhatTheRampLosesHoweverShortTheStep) {
    Bone bone = testing::make_block(glm::dvec3(-1.5), glm::dvec3(1.5), voxel_mm);
    NoEdits edits;
    constexpr double radius = 8.0;
    const glm::dvec3 step(0.013, 0.004, -0.006);
    glm::dvec3 at = to_voxel_coordinates(bone.grid(), {-0.02, 0.01, 0.03});
    Losses first;
    carve(bone, {at, at, radius}, CarveHistory::none, {}, edits, first);
    for (int i = 0; i < 20; ++i) {
        Losses losses;
        carve(bone, {at, at + step, radius}, CarveHistory::carved_at_from, {}, edits, losses);
        const double expected = loss_of_whole_bone(at, at + step, radius);
        EXPECT_NEAR(losses.whole_steps + losses.beyond_steps, expected, 0.01 * expected);
        EXPECT_LE(losses.largest, 1.02) << "no voxel is off by more than it is rounded by at both ends";
        at += step;
    }
}

TEST(UnroundedLoss, IsNoneAtRestAndInAir) {
    Bone bone = testing::make_block(glm::dvec3(-1.5), {1.5, 1.5, 0.0}, voxel_mm);
    NoEdits edits;
    const auto voxels = [&](const glm::dvec3& mm) { return to_voxel_coordinates(bone.grid(), mm); };
    Losses losses;
    const glm::dvec3 sunk = voxels({0.0, 0.0, 0.3});
    carve(bone, {sunk, sunk, 8.0}, CarveHistory::none, {}, edits, losses);
    losses = {};
    carve(bone, {sunk, sunk, 8.0}, CarveHistory::carved_at_from, {}, edits, losses);
    carve(bone, {voxels({0.0, 0.0, 1.1}), voxels({0.01, 0.0, 1.1}), 8.0}, CarveHistory::carved_at_from, {},
          edits, losses);
    EXPECT_EQ(losses.beyond_steps, 0.0);
    EXPECT_EQ(losses.whole_steps, 0.0);
}

/// Mean force, N, of a burr that goes on at 0.5 mm/s from `from_mm`.
double mean_force_n(MillingModel& model, const glm::dvec3& from_mm, const glm::dvec3& direction, int steps) {
    constexpr double step_s = 0.01;
    NoEdits edits;
    MillingResult result;
    double sum_n = 0.0;
    for (int i = 1; i <= steps; ++i) {
        model.step({.pose = {.position_mm = from_mm + direction * (0.5 * step_s * i)},
                    .spindle_on = true,
                    .elapsed_s = step_s,
                    .wants_engagement = false},
                   i * step_s, edits, result);
        sum_n += glm::length(result.force_n) / steps;
    }
    return sum_n;
}

TEST(UnroundedLoss, IsNothingToFeelOnTheWayBackThroughTheBurrsOwnGroove) {
    const Bone block = testing::make_block({-4.0, -3.5, -1.0}, {4.0, 3.5, 0.0}, voxel_mm);
    MillingModel model(block, {Burr{.diameter_mm = 5.0}}, {}, {});
    const glm::dvec3 start(-0.5, 0.0, 2.0);
    const glm::dvec3 along(1.0, 0.0, 0.0);
    mean_force_n(model, start, along, 20);
    const double cutting_n = mean_force_n(model, start + 0.1 * along, along, 40);
    EXPECT_GT(cutting_n, 0.03);
    const glm::dvec3 turn = start + 0.3 * along;
    EXPECT_LT(mean_force_n(model, turn, -along, 10), 0.01 * cutting_n);
    EXPECT_LT(mean_force_n(model, turn - 0.05 * along, -along, 10), 0.005 * cutting_n);
}

}  // namespace
}  // namespace osteomill
