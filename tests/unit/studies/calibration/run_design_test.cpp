#include "analysis/calibration/run_design.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <set>

#include "tests/unit/studies/calibration/synthetic_runs.h"

namespace osteomill::study {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

RunLattice small_lattice() {
    return {.diameters_mm = {1.0, 4.0},
            .feeds_mm_per_s = {1.0, 10.0},
            .rpm = {20'000.0},
            .depths_mm = {0.4, 1.0},
            .tilts_deg = {0.0, 30.0},
            .tilt_directions_deg = {0.0, 90.0, 180.0}};
}

TEST(RunDesign, HasCandidatesThatALabCanCut) {
    const auto candidates = candidates_of(small_lattice());
    EXPECT_EQ(candidates.size(), (1u + 2u) * 2u * 4u)
        << "no slot of 1 mm by the 1 mm burr; an upright burr leans nowhere";
    for (const Candidate& c : candidates) {
        EXPECT_LE(c.setting.depth_mm, 0.5 * c.setting.diameter_mm);
        EXPECT_LT((c.regressors - regressors_of(c.setting)).norm(), 1e-9);
    }
}

TEST(RunDesign, IsTheBestOfAllWhereAllCanBeTried) {
    auto candidates = candidates_of(small_lattice());
    candidates.resize(12);
    const RunDesign found = optimal_design(candidates, 4, 1);
    double best = 0.0;
    for (int set = 0; set < 1 << 12; ++set) {
        if (__builtin_popcount(static_cast<unsigned>(set)) != 4) continue;
        Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
        for (std::size_t i = 0; i < 12; ++i)
            if ((set >> i & 1) != 0)
                information += candidates[i].regressors.transpose() * candidates[i].regressors;
        best = std::max(best, information.determinant());
    }
    EXPECT_NEAR(found.determinant / best, 1.0, 1e-6);
}

TEST(RunDesign, TellsMoreThanOneFactorAtATime) {
    const RunLattice lattice{.diameters_mm = {4.0},
                             .feeds_mm_per_s = {1.0, 4.0, 16.0},
                             .rpm = {20'000.0},
                             .depths_mm = {0.2, 0.5, 1.0},
                             .tilts_deg = {0.0, 30.0},
                             .tilt_directions_deg = {0.0, 180.0}};
    const RunDesign design = optimal_design(candidates_of(lattice), 12, 1);
    const RunDesign grid = one_factor_at_a_time(lattice, 12);
    EXPECT_EQ(design.settings.size(), 12u);
    EXPECT_EQ(grid.settings.size(), 12u);
    EXPECT_LT(design.condition, largest_condition);
    EXPECT_GT(efficiency(design, grid), 2.0);
}

TEST(RunDesign, PromisesTheUncertaintyThatAFitThenHas) {
    const RunDesign design = optimal_design(candidates_of(small_lattice()), 12, 1);
    const CoefficientFit fit = fit_coefficients(exact_forces(design.settings, 0.05));
    EXPECT_LT((fit.uncertainty - 0.05 * design.uncertainty).cwiseQuotient(fit.uncertainty).norm(), 1e-6);
}

TEST(RunDesign, IsTheSameForTheSameSeed) {
    const auto candidates = candidates_of(small_lattice());
    EXPECT_EQ(optimal_design(candidates, 8, 3).determinant, optimal_design(candidates, 8, 3).determinant);
}

TEST(RunDesign, IsRefusedWhereTheListsCannotGiveIt) {
    RunLattice lattice = small_lattice();
    EXPECT_THAT([&] { optimal_design(candidates_of(lattice), 25, 1); },
                ThrowsMessage<std::runtime_error>(HasSubstr("the lists make 24 settings")));
    lattice.feeds_mm_per_s = {5.0, 6.0};
    EXPECT_THAT([&] { optimal_design(candidates_of(lattice), 12, 1); },
                ThrowsMessage<std::runtime_error>(HasSubstr("the feed of a tooth is")));
    EXPECT_THAT([&] { optimal_design(candidates_of(lattice), 2, 1); },
                ThrowsMessage<std::runtime_error>(HasSubstr("at least 3")));
}

}  // namespace
}  // namespace osteomill::study
