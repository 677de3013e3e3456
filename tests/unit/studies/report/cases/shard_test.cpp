#include "analysis/output/cases/shard.h"

#include <gmock/gmock.h>

#include <set>
#include <stdexcept>

namespace osteomill::study::shard_test {
namespace {

TEST(Shard, PartsHaveEveryCaseOnceAndAreAlike) {
    std::vector<std::string> names;
    for (int grip = 0; grip < 250; ++grip)
        for (const char* delay : {"on time", "late", "later", "too late"})
            names.push_back("grip " + std::to_string(grip) + ", " + delay);
    std::set<std::size_t> seen;
    for (std::size_t number = 1; number <= 4; ++number) {
        const auto part = cases_of({number, 4}, names);
        EXPECT_EQ(part.size(), 250U);
        std::size_t on_time = 0;
        for (const std::size_t index : part) {
            EXPECT_TRUE(seen.insert(index).second);
            on_time += index % 4 == 0 ? 1U : 0U;
        }
        // Parts that took every fourth case would have all of one delay, or none.
        EXPECT_NEAR(static_cast<double>(on_time) / static_cast<double>(part.size()), 0.25, 0.1);
    }
    EXPECT_EQ(seen.size(), names.size());
    EXPECT_EQ(cases_of({2, 4}, names), cases_of({2, 4}, names));
    EXPECT_TRUE(cases_of({4, 4}, {"one", "two"}).empty());
}

TEST(Shard, IsNamedByNumberAndCount) {
    EXPECT_EQ(shard_named("2/8"), (Shard{2, 8}));
    for (const char* wrong : {"", "2", "/", "0/8", "9/8", "2/8x", "-1/8", "2/", "a/b"})
        EXPECT_THROW(shard_named(wrong), std::invalid_argument) << wrong;
}

TEST(Shard, FingerprintKnowsAListFromAnother) {
    EXPECT_EQ(fingerprint_of({"a", "b"}), fingerprint_of({"a", "b"}));
    EXPECT_NE(fingerprint_of({"a", "b"}), fingerprint_of({"b", "a"}));
    EXPECT_NE(fingerprint_of({"a", "b"}), fingerprint_of({"ab"}));
    EXPECT_EQ(fingerprint_of_program().size(), 16U);
}

}  // namespace
}  // namespace osteomill::study::shard_test
