#include "render_client/volume/steps.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill::steps_test {
namespace {

Steps count_to(int last, int& reached) {
    while (reached < last) {
        ++reached;
        co_yield static_cast<double>(reached) / last;
    }
}

Steps fails_in_its_second_step() {
    co_yield 0.5;
    throw std::runtime_error("no more");
}

TEST(Steps, DoNothingUntilAskedAndThenAStepAtATime) {
    int reached = 0;
    Steps steps = count_to(3, reached);
    EXPECT_EQ(reached, 0);
    EXPECT_TRUE(steps.step());
    EXPECT_EQ(reached, 1);
    EXPECT_DOUBLE_EQ(steps.done(), 1.0 / 3.0);
    EXPECT_TRUE(steps.step());
    EXPECT_TRUE(steps.step());
    EXPECT_FALSE(steps.step());
    EXPECT_FALSE(steps.step()) << "it stays done";
    EXPECT_EQ(steps.done(), 1.0);
}

TEST(Steps, EndWhereTheyAreDropped) {
    int reached = 0;
    {
        Steps steps = count_to(3, reached);
        steps.step();
        Steps moved = std::move(steps);
        moved.step();
    }
    EXPECT_EQ(reached, 2);
}

TEST(Steps, ThrowWhatTheWorkThrowsAndAreThenOver) {
    Steps steps = fails_in_its_second_step();
    EXPECT_TRUE(steps.step());
    EXPECT_THROW(steps.step(), std::runtime_error);
    EXPECT_FALSE(steps.step());
}

TEST(Steps, GiveAVectorItsSizeAndValueInMoreThanOneStepWhereItIsLarge) {
    std::vector<int> values{7};
    Steps steps = grow(values, 3'000'000, 5);
    int count = 0;
    while (steps.step()) ++count;
    EXPECT_GT(count, 1);
    EXPECT_EQ(values, std::vector<int>(3'000'000, 5));
}

TEST(Steps, OfAPartMakeAPartOfTheWhole) {
    int reached = 0;
    Steps steps = count_to(2, reached);
    steps.step();
    EXPECT_DOUBLE_EQ(part_of(steps, 0.2, 0.4), 0.3);
}

}  // namespace
}  // namespace osteomill::steps_test
