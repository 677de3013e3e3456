#include "analysis/output/sweep.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace osteomill::study::sweep_test {
namespace {

TEST(Sweep, RunsEachCaseOnceOnSeveralThreads) {
    std::map<std::size_t, int> times;
    sweep(
        100, 4, [](std::size_t i) { return 2 * i; },
        [&](std::size_t i, std::size_t outcome) {
            ++times[i];
            EXPECT_EQ(outcome, 2 * i);
        });
    EXPECT_EQ(times.size(), 100U);
    for (const auto& [i, count] : times) EXPECT_EQ(count, 1) << i;
}

TEST(Sweep, EndsAtTheFirstFailure) {
    std::size_t done = 0;
    const auto fails_at_ten = [](std::size_t i) {
        if (i == 10) throw std::invalid_argument("no tenth today");
        return i;
    };
    EXPECT_THROW(sweep(100, 1, fails_at_ten, [&](std::size_t, std::size_t) { ++done; }),
                 std::invalid_argument);
    EXPECT_EQ(done, 10U);
}

}  // namespace
}  // namespace osteomill::study::sweep_test
