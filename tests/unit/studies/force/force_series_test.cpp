#include <gtest/gtest.h>

#include <limits>

#include "studies/force/path_run.h"

namespace osteomill::study {
namespace {

TEST(RelativeError, IsTheVectorErrorOverTheVectorNorm) {
    EXPECT_DOUBLE_EQ(relative_error({3.0, 4.0, 0.5}, {3.0, 4.0, 0.0}), 0.1);
    EXPECT_EQ(relative_error(glm::dvec3(0.0), glm::dvec3(0.0)), 0.0);
    EXPECT_EQ(relative_error({1.0, 0.0, 0.0}, glm::dvec3(0.0)), std::numeric_limits<double>::infinity());
}

TEST(ForceSeriesMeans, AreOverStepsAndOverTime) {
    const ForceSeries series{.step_s = 0.5, .force_n = {{1, 0, 0}, {3, 2, 0}}, .removed_mm3 = {2.0, 4.0}};
    EXPECT_EQ(mean_force_n(series), glm::dvec3(2.0, 1.0, 0.0));
    EXPECT_DOUBLE_EQ(removal_mm3_per_s(series), 6.0);
    EXPECT_EQ(mean_force_n(ForceSeries{}), glm::dvec3(0.0));
}

TEST(Ripple, IsTheRootMeanSquareAboutTheMean) {
    // Swings by 0.3 across a mean of 3: one tenth, whatever the axis.
    const ForceSeries series{.step_s = 0.01,
                             .force_n = {{3, 0.3, 0}, {3, -0.3, 0}, {3, 0, 0.3}, {3, 0, -0.3}}};
    EXPECT_DOUBLE_EQ(ripple(series), 0.1);
    EXPECT_EQ(ripple(ForceSeries{.step_s = 0.01, .force_n = {{0, 0, 0}, {0, 0, 0}}}), 0.0);
}

TEST(Ripple, DoesNotSeeWhatAveragesOutWithinTenMilliseconds) {
    ForceSeries series{.step_s = 0.001};
    for (int i = 0; i < 40; ++i) series.force_n.emplace_back(i % 2 == 0 ? 1.0 : 3.0, 0.0, 0.0);
    EXPECT_NEAR(ripple(series), 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(ripple(series, 0.001), 0.5);
}

}  // namespace
}  // namespace osteomill::study
