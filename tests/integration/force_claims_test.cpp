// What the documents claim of the milling force, on motions that nothing was tuned to.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

TEST(ForceClaims, HoldOverRandomMotions) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "accuracy is the optimised program's; under a sanitizer it takes minutes";
#endif
    const testing::TemporaryFolder folder;
    const std::string command = STUDY " force --random 500 --seed 20261122 --out '" + folder.path().string() +
                                "' >/dev/null 2>&1 </dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto found = nlohmann::json::parse(std::ifstream(folder / "random.json"));
    EXPECT_EQ(found.at("cases"), 500);
    EXPECT_LT(found.at("median_error_percent"), 0.3);
    EXPECT_LT(found.at("p95_error_percent"), 2.0);
    EXPECT_LT(found.at("p99_error_percent"), 6.0);
    EXPECT_LT(found.at("ripple_p90_percent"), 2.5);
}

}  // namespace
}  // namespace osteomill
