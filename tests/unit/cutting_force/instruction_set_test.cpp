// Every instruction set gives the same bits.
#include "simulation/carving/instruction_set.h"

#include <gtest/gtest.h>

#include <random>

#include "simulation/carving/voxel_coverage.h"
#include "simulation/cutting_force/chip_force.h"
#include "tests/support/steady_motion.h"

namespace osteomill::instruction_set_test {
namespace {

class InstructionSets : public ::testing::Test {
  protected:
    void SetUp() override {
        if (best_instruction_set() == InstructionSet::plain)
            GTEST_SKIP() << "this processor has no other set";
    }
};

RemovedVoxels random_voxels() {
    RemovedVoxels voxels;
    voxels.base = {40, 50, 60};
    voxels.count = 509;
    std::mt19937 random(1);
    std::uniform_int_distribution<int> position(0, 60);
    for (std::size_t i = 0; i < voxels.count; ++i) {
        voxels.x[i] = static_cast<float>(position(random));
        voxels.y[i] = static_cast<float>(position(random));
        voxels.z[i] = static_cast<float>(position(random));
        voxels.levels[i] = static_cast<float>(position(random));
    }
    voxels.pad();
    return voxels;
}

TEST_F(InstructionSets, CoverVoxelsAlike) {
    const RemovedVoxels voxels = random_voxels();
    const std::size_t count = voxels.padded_count();
    for (const VoxelCoverage coverage :
         {VoxelCoverage::linear, VoxelCoverage::smoothed, VoxelCoverage::binary}) {
        const SweepSeenFrom sweep({{70.3, 80.1, 90.7}, {70.9, 80.0, 90.5}, 25.0}, glm::dvec3(voxels.base),
                                  coverage);
        std::array<std::vector<std::int32_t>, 2> left;
        for (const InstructionSet set : {InstructionSet::plain, best_instruction_set()}) {
            auto& out = left[set == InstructionSet::plain ? 0 : 1];
            out.resize(count);
            levels_left(sweep, {voxels.x.data(), count}, {voxels.y.data(), count}, {voxels.z.data(), count},
                        out, set);
        }
        EXPECT_EQ(left[0], left[1]);
        EXPECT_NE(std::count(left[0].begin(), left[0].end(), 0), 0);
        EXPECT_NE(std::count(left[0].begin(), left[0].end(), 255), 0);
    }
}

TEST_F(InstructionSets, SumForcesAlike) {
    const RemovedVoxels voxels = random_voxels();
    const Burr burr{.edge_coefficients_n_per_mm = {0.3, 0.2, 0.1}};
    const CuttingStep chips(burr, glm::normalize(glm::dvec3(0.3, -0.2, 0.9)), {70.3, 80.1, 90.7}, 0.1, 0.001);
    for (const CuttingStep& step : {chips, chips.of_edges(burr, {70.3, 80.1, 90.7}, {0.1, 0.2, -0.1})}) {
        const glm::dvec3 plain = sum_of_chip_forces(step, voxels, voxels.levels, InstructionSet::plain);
        EXPECT_EQ(plain, sum_of_chip_forces(step, voxels, voxels.levels, best_instruction_set()));
        EXPECT_GT(glm::length(plain), 0.0);
    }
}

TEST_F(InstructionSets, MillAlike) {
    const auto cases = testing::reference_cases();
    for (const std::size_t i : {std::size_t{2}, cases.size() - 1}) {
        const auto plain =
            testing::run_steady(cases[i], 0.1, 0.002, 0.5, {.instructions = InstructionSet::plain});
        const auto best =
            testing::run_steady(cases[i], 0.1, 0.002, 0.5, {.instructions = best_instruction_set()});
        EXPECT_EQ(plain.mean_force_n, best.mean_force_n) << cases[i].name;
        EXPECT_EQ(plain.removal_mm3_per_s, best.removal_mm3_per_s) << cases[i].name;
    }
}

TEST_F(InstructionSets, MillSlowlyAlike) {
    auto slow = testing::reference_cases().front();
    slow.velocity_mm_per_s *= 0.5 / glm::length(slow.velocity_mm_per_s);
    const auto plain = testing::run_steady(slow, 0.1, 0.01, 0.1, {.instructions = InstructionSet::plain});
    const auto best = testing::run_steady(slow, 0.1, 0.01, 0.1, {.instructions = best_instruction_set()});
    EXPECT_EQ(plain.mean_force_n, best.mean_force_n);
}

}  // namespace
}  // namespace osteomill::instruction_set_test
