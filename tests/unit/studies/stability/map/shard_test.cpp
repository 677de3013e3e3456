#include "studies/stability/map/shard.h"

#include <gmock/gmock.h>

#include <set>
#include <stdexcept>

namespace osteomill::study::shard_test {
namespace {

TEST(Shard, PartsHaveEveryCaseOnceAndAreAlike) {
    const auto points = map_points({.quick = true});
    std::set<std::size_t> seen;
    for (std::size_t number = 1; number <= 4; ++number) {
        const auto part = cases_of({number, 4}, points);
        EXPECT_NEAR(static_cast<double>(part.size()), static_cast<double>(points.size()) / 4.0, 1.0);
        std::size_t without_delay = 0;
        for (const std::size_t index : part) {
            EXPECT_TRUE(seen.insert(index).second);
            without_delay += points.at(index).run.delay_ticks == 0 ? 1U : 0U;
        }
        // The list goes through the delays innermost: parts that took every fourth case would have one each.
        EXPECT_NEAR(static_cast<double>(without_delay) / static_cast<double>(part.size()), 0.55, 0.1);
    }
    EXPECT_EQ(seen.size(), points.size());
}

TEST(Shard, IsNamedByNumberAndCount) {
    EXPECT_EQ(shard_named("2/8"), (Shard{2, 8}));
    for (const char* wrong : {"", "2", "/", "0/8", "9/8", "2/8x", "-1/8", "2/", "a/b"})
        EXPECT_THROW(shard_named(wrong), std::invalid_argument) << wrong;
}

TEST(Shard, FingerprintKnowsAListFromAnother) {
    const auto points = map_points({.quick = true, .methods = {"hold"}});
    auto other = points;
    other.back().run.depth_mm += 0.1;
    EXPECT_EQ(fingerprint_of(points), fingerprint_of(map_points({.quick = true, .methods = {"hold"}})));
    EXPECT_NE(fingerprint_of(points), fingerprint_of(other));
}

}  // namespace
}  // namespace osteomill::study::shard_test
