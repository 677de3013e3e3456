#include "studies/stability/rails/motion_on_rails.h"

#include <gtest/gtest.h>

#include "common/statistics/percentile.h"
#include "studies/force/path_run.h"

namespace osteomill::study::motion_on_rails_test {
namespace {

TEST(MotionOnRails, GivesTheHandTheModelsMeanForce) {
    std::vector<double> errors;
    for (const SteadyCase& motion : motions_on_rails(12, 2026)) {
        const OnRails run = run_on_rails(motion, "implicit");
        if (!run.is_driven) errors.push_back(relative_error(run.hand_n, run.model_n));
    }
    EXPECT_GE(errors.size(), 8U);
    EXPECT_LT(percentile(errors, 0.95), 0.01);
    EXPECT_LT(percentile(errors, 0.5), 0.002);
}

TEST(MotionOnRails, DrawsTheSameMotionsForASeed) {
    const auto some = motions_on_rails(3, 7);
    const auto more = motions_on_rails(4, 7);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i].name, more[i].name);
    EXPECT_NE(motions_on_rails(1, 8).front().name, some.front().name);
}

}  // namespace
}  // namespace osteomill::study::motion_on_rails_test
