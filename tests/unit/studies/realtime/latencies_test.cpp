#include "studies/realtime/latencies.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::study {
namespace {

const std::vector<std::string> columns{"load", "what", "from_us", "up_to_us", "share", "share_above"};

TEST(Latencies, ReadThoseOfTheServerAndGatherThem) {
    const auto histogram = nlohmann::json::parse("[[1.5, 990], [40.0, 9], [1200.0, 1]]");
    Latencies latencies = latencies_of_server(histogram);
    EXPECT_EQ(latencies.count(), 1000u);
    EXPECT_EQ(latencies.quantile_us(0.5), 1.5);
    EXPECT_EQ(latencies.quantile_us(0.999), 40.0);
    EXPECT_EQ(latencies.quantile_us(1.0), 1200.0);
    EXPECT_EQ(latencies.over(1000.0), 1u);
    latencies.add(latencies_of_server(nlohmann::json::parse("[[1.5, 5], [1000.0, 2]]")));
    EXPECT_EQ(latencies.count(), 1007u);
    EXPECT_EQ(latencies.over(1000.0), 1u) << "1000 us are not over";
    EXPECT_EQ(latencies.max_us(), 1200.0);
}

TEST(Latencies, ReadThoseOfCyclictestAndTheOnesBeyondItsHistogram) {
    const auto report = nlohmann::json::parse(
        R"({"thread": {"0": {"histogram": {"12": 900, "999": 90, "1000": 7}, "cycles": 1000, "max": 31000}}})");
    const Latencies latencies = latencies_of_cyclictest(report);
    EXPECT_EQ(latencies.count(), 1000u);
    EXPECT_EQ(latencies.quantile_us(0.9), 13.0) << "12 is up to 13";
    EXPECT_EQ(latencies.over(1000.0), 10u);
    EXPECT_EQ(latencies.max_us(), 31001.0);
}

TEST(Latencies, AreNothingWhereThereAreNone) {
    const Latencies none;
    EXPECT_EQ(none.quantile_us(0.999), 0.0);
    EXPECT_EQ(none.max_us(), 0.0);
    Table table(columns);
    add_bins(table, none, "quiet", "wakeup");
    EXPECT_TRUE(table.json().empty());
}

TEST(Latencies, ComeAsATableWhoseSharesAddUp) {
    Latencies latencies;
    latencies.add(0.1, 10);
    latencies.add(13.0, 980);
    latencies.add(250.0, 10);
    Table table(columns);
    add_bins(table, latencies, "quiet", "wakeup");
    double sum = 0.0;
    double share_above = 1.0;
    double last_up_to_us = 0.0;
    for (const auto& row : table.json()) {
        const double from_us = row.at("from_us");
        const double up_to_us = row.at("up_to_us");
        const double share = row.at("share");
        share_above = row.at("share_above");
        sum += share;
        ASSERT_NEAR(share_above, 1.0 - sum, 1e-5);
        if (up_to_us >= 13.0 && from_us < 13.0) {
            EXPECT_NEAR(share, 0.98, 1e-9);
        }
        if (last_up_to_us > 0.0) {
            EXPECT_NEAR(from_us, last_up_to_us, 2e-3 * from_us) << "no gap between bins";
        }
        last_up_to_us = up_to_us;
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_EQ(share_above, 0.0);
}

}  // namespace
}  // namespace osteomill::study
