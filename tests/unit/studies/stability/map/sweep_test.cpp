#include "studies/stability/map/sweep.h"

#include <gmock/gmock.h>

#include <map>
#include <stdexcept>

namespace osteomill::study::sweep_test {
namespace {

using ::testing::HasSubstr;

MapOutcome depth_of(const MapCase& c) {
    return {.depth_error_mm = c.depth_mm};
}

TEST(Sweep, RunsEachCaseOnceOnSeveralThreads) {
    const auto points = map_points({.quick = true});
    std::vector<std::size_t> every_third;
    for (std::size_t i = 0; i < points.size(); i += 3) every_third.push_back(i);
    std::map<std::size_t, int> times;
    sweep(points, every_third, 4, depth_of, [&](std::size_t index, const MapOutcome& outcome) {
        ++times[index];
        EXPECT_EQ(outcome.depth_error_mm, points[index].run.depth_mm);
    });
    EXPECT_EQ(times.size(), every_third.size());
    for (const auto& [index, count] : times) EXPECT_EQ(count, 1) << index;
}

TEST(Sweep, EndsAtTheFirstFailureAndNamesTheCase) {
    const auto points = map_points({.quick = true});
    const auto fails_on_a_wall = [](const MapCase& c) {
        if (c.scene == MapScene::wall) throw std::invalid_argument("no wall today");
        return MapOutcome{};
    };
    std::vector<std::size_t> all(points.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    std::size_t done = 0;
    try {
        sweep(points, all, 2, fails_on_a_wall, [&](std::size_t, const MapOutcome&) { ++done; });
        FAIL() << "swept";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("case 'implicit, wall of 0.1 N/mm, bare-arm"));
        EXPECT_THAT(error.what(), HasSubstr("no wall today"));
    }
    EXPECT_LT(done, all.size());
}

}  // namespace
}  // namespace osteomill::study::sweep_test
