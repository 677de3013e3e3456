#include "studies/stability/rails/motion_on_rails.h"

#include <gtest/gtest.h>

namespace osteomill::study::motion_on_rails_test {
namespace {

TEST(MotionOnRails, GivesTheHandTheModelsMeanForce) {
    std::vector<RailsResult> results;
    for (const SteadyCase& motion : motions_on_rails(12, 2026))
        results.push_back({motion.name, run_on_rails(motion, "implicit")});
    const nlohmann::ordered_json summary = summary_of(results);
    EXPECT_EQ(summary.at("cases"), 12);
    EXPECT_LE(summary.at("driven").get<int>(), 4);
    EXPECT_LT(summary.at("p95_error_percent").get<double>(), 1.0) << summary.at("worst");
    EXPECT_LT(summary.at("median_error_percent").get<double>(), 0.2);
}

TEST(MotionOnRails, DrawsTheSameMotionsForASeed) {
    const auto some = motions_on_rails(3, 7);
    const auto more = motions_on_rails(4, 7);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i].name, more[i].name);
    EXPECT_NE(motions_on_rails(1, 8).front().name, some.front().name);
}

}  // namespace
}  // namespace osteomill::study::motion_on_rails_test
