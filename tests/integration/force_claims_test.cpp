// What the documents claim of the milling force, on motions that nothing was tuned to.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

/// random.json of `osteomill_study force` with these options.
nlohmann::json measured(const std::string& options) {
    const testing::TemporaryFolder folder;
    const std::string command =
        STUDY " force " + options + " --out '" + folder.path().string() + "' >/dev/null 2>&1 </dev/null";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("the study failed: " + options);
    return nlohmann::json::parse(std::ifstream(folder / "random.json"));
}

TEST(ForceClaims, HoldOverRandomMotions) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "accuracy is the optimised program's; under a sanitizer it takes minutes";
#endif
    const auto found = measured("--random 500 --seed 20261122");
    EXPECT_EQ(found.at("cases"), 500);
    EXPECT_LT(found.at("median_error_percent"), 0.3);
    EXPECT_LT(found.at("p95_error_percent"), 2.0);
    EXPECT_LT(found.at("p99_error_percent"), 6.0);
    EXPECT_LT(found.at("ripple_p90_from_5_mm_per_s_percent"), 2.5);
    // Slower steps take a level here and there of a voxel's 255.
    EXPECT_LT(found.at("ripple_p90_percent"), 5.0);
}

TEST(ForceClaims, HoldWithEdgesThatRub) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "accuracy is the optimised program's; under a sanitizer it takes minutes";
#endif
    const auto found = measured("--random 300 --seed 20261123 --edge-forces");
    EXPECT_EQ(found.at("cases"), 300);
    EXPECT_LT(found.at("median_error_percent"), 1.0);
    EXPECT_LT(found.at("p95_error_percent"), 4.0);
    EXPECT_LT(found.at("p99_error_percent"), 6.0);
    EXPECT_LT(found.at("window_p95_percent"), 10.0);
    EXPECT_LT(found.at("largest_step_max"), 2.0);
}

TEST(ForceClaims, HoldForHeadsWhoseEdgesRub) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "accuracy is the optimised program's; under a sanitizer it takes minutes";
#endif
    const auto found = measured("--random 60 --seed 20261125 --heads --edge-forces");
    EXPECT_EQ(found.at("cases"), 60);
    EXPECT_LT(found.at("median_error_percent"), 2.0);
    EXPECT_LT(found.at("window_p95_percent"), 10.0);
}

TEST(ForceClaims, HoldForHeadsThatAreNoBall) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "accuracy is the optimised program's; under a sanitizer it takes minutes";
#endif
    const auto found = measured("--random 150 --seed 20261124 --heads");
    EXPECT_EQ(found.at("cases"), 150);
    EXPECT_LT(found.at("median_error_percent"), 0.3);
    EXPECT_LT(found.at("p95_error_percent"), 2.0);
}

}  // namespace
}  // namespace osteomill
