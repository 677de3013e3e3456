#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include "common/bone/brick.h"

namespace osteomill::brick_table_test {
namespace {

constexpr BrickIndex largest = std::numeric_limits<BrickIndex>::max();

TEST(BrickTable, WithoutBricksFindsNone) {
    const BrickTable table;
    for (const BrickIndex brick : {BrickIndex{0}, BrickIndex{1}, largest})
        EXPECT_EQ(table.find(brick), BrickTable::no_slot);
}

TEST(BrickTable, FindsWhatAMapFinds) {
    std::mt19937 random(3);
    // From few possible bricks, of which many are stored, to all that an index can name.
    for (const BrickIndex last : {BrickIndex{50}, BrickIndex{5000}, largest}) {
        std::uniform_int_distribution<BrickIndex> any(0, last);
        std::vector<BrickIndex> bricks;
        std::map<BrickIndex, std::int32_t> expected;
        for (int i = 0; i < 3000; ++i) {
            const BrickIndex brick = any(random);
            if (!expected.emplace(brick, static_cast<std::int32_t>(bricks.size())).second) continue;
            bricks.push_back(brick);
        }
        const BrickTable table(bricks);
        for (const auto& [brick, slot] : expected) EXPECT_EQ(table.find(brick), slot);
        for (int i = 0; i < 3000; ++i) {
            const BrickIndex brick = any(random);
            const auto found = expected.find(brick);
            EXPECT_EQ(table.find(brick), found == expected.end() ? BrickTable::no_slot : found->second);
        }
    }
}

TEST(BrickTable, FindsTheFirstAndTheLastBrickThereCanBe) {
    const BrickTable table(std::vector<BrickIndex>{0, largest});
    EXPECT_EQ(table.find(0), 0);
    EXPECT_EQ(table.find(largest), 1);
    EXPECT_EQ(table.find(largest - 1), BrickTable::no_slot);
}

TEST(BrickTable, RefusesABrickThatComesTwice) {
    EXPECT_THROW(BrickTable(std::vector<BrickIndex>{4, 7, 4}), std::invalid_argument);
}

TEST(BrickTable, TakesAtMost32BytesABrick) {
    std::vector<BrickIndex> bricks;
    while (bricks.size() < 300) {
        bricks.push_back(7 * static_cast<BrickIndex>(bricks.size()));
        EXPECT_LE(BrickTable(bricks).memory_bytes(), 32 * bricks.size());
    }
}

}  // namespace
}  // namespace osteomill::brick_table_test
