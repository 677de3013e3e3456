#include <gtest/gtest.h>

#include <vector>

#include "common/bone/bone.h"

namespace osteomill {
namespace {

FractionBricks three_bricks() {
    std::vector<ByteBrick> bricks(3);
    for (std::size_t slot = 0; slot < bricks.size(); ++slot)
        bricks[slot].fill(static_cast<std::uint8_t>(100 + slot));
    return FractionBricks(std::move(bricks));
}

TEST(FractionBricks, PlainCopiesShareNothing) {
    FractionBricks bricks = three_bricks();
    FractionBricks copy = bricks;
    EXPECT_NE(copy[1].data(), bricks[1].data());
    EXPECT_EQ(copy.own_bricks(), 3U);
    copy.to_write(1)[7] = 3;
    EXPECT_EQ(bricks[1][7], 101);
    EXPECT_EQ(copy[1][7], 3);
    EXPECT_EQ(copy[1][8], 101);
}

TEST(FractionBricks, SharedCopiesOwnWhatIsWrittenTo) {
    FractionBricks bricks = three_bricks();
    bricks.share();
    FractionBricks copy = bricks;
    EXPECT_EQ(copy.own_bricks(), 0U);
    for (std::size_t slot = 0; slot < 3; ++slot) EXPECT_EQ(copy[slot].data(), bricks[slot].data());

    copy.to_write(1)[7] = 3;
    copy.to_write(1)[8] = 4;
    EXPECT_EQ(copy.own_bricks(), 1U) << "copied once";
    EXPECT_EQ(bricks.own_bricks(), 0U);
    EXPECT_EQ(bricks[1][7], 101);
    EXPECT_EQ(copy[1][7], 3);
    EXPECT_EQ(copy[1][8], 4);
    EXPECT_EQ(copy[1][9], 101);
    EXPECT_EQ(copy[0].data(), bricks[0].data());
}

TEST(FractionBricks, ACopyOfACopyDisturbsNeither) {
    FractionBricks bricks = three_bricks();
    bricks.share();
    FractionBricks first = bricks;
    first.to_write(0)[0] = 1;
    FractionBricks second = first;
    second.to_write(0)[0] = 2;
    second.to_write(2)[0] = 2;
    EXPECT_EQ(bricks[0][0], 100);
    EXPECT_EQ(first[0][0], 1);
    EXPECT_EQ(first[2][0], 102);
    EXPECT_EQ(second[0][0], 2);
    EXPECT_EQ(second[2][0], 2);
    EXPECT_EQ(first.own_bricks(), 1U);
    EXPECT_EQ(second.own_bricks(), 2U);
}

TEST(FractionBricks, WhoSharesMayGo) {
    std::vector<FractionBricks> copies;
    {
        FractionBricks bricks = three_bricks();
        bricks.share();
        copies.push_back(bricks);
    }
    EXPECT_EQ(copies[0][2][4095], 102);
    copies[0].to_write(2)[4095] = 9;
    copies.push_back(copies[0]);
    copies.erase(copies.begin());
    EXPECT_EQ(copies[0][2][4095], 9);
    EXPECT_EQ(copies[0][2][4094], 102);
}

TEST(FractionBricks, WhatIsSharedAgainIsCopiedNoMore) {
    FractionBricks bricks = three_bricks();
    bricks.share();
    bricks.to_write(1)[0] = 5;
    const FractionBricks before = bricks;
    EXPECT_EQ(before.own_bricks(), 1U);
    bricks.share();
    FractionBricks after = bricks;
    EXPECT_EQ(after.own_bricks(), 0U);
    EXPECT_EQ(after[1][0], 5);
    after.to_write(1)[0] = 6;
    EXPECT_EQ(bricks[1][0], 5);
    EXPECT_EQ(before[1][0], 5);
}

TEST(FractionBricks, OneThatWasMovedFromCanBeCopiedAndAssigned) {
    FractionBricks bricks = three_bricks();
    FractionBricks moved = std::move(bricks);
    EXPECT_EQ(moved[0][0], 100);
    const FractionBricks empty = bricks;  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(empty.size(), 0U);
    bricks = moved;
    EXPECT_EQ(bricks[2][0], 102);
    EXPECT_NE(bricks[2].data(), moved[2].data());
}

}  // namespace
}  // namespace osteomill
