#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/hid/arm_link.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;

std::vector<std::uint8_t> bytes_of(const ArmOutput& output) {
    return {output.bytes().begin(), output.bytes().end()};
}

TEST(ArmReport, ReadsLittleEndianCountsOfTheSecondGeneration) {
    // 256 + 1, -2, 32 767; 3, -4, 5; info 1
    const std::array<std::uint8_t, 14> report{0x01, 0x01, 0xFE, 0xFF, 0xFF, 0x7F, 3,
                                              0,    0xFC, 0xFF, 5,    0,    1,    0};
    const auto input = decode_arm_report(report);
    ASSERT_TRUE(input);
    EXPECT_EQ(input->generation, ArmGeneration::second);
    EXPECT_THAT(input->arm_counts, ElementsAre(257, -2, 32'767));
    EXPECT_THAT(input->stylus_counts, ElementsAre(3, -4, 5));
    EXPECT_FALSE(input->is_switch_pressed);
    EXPECT_TRUE(input->asks_for_calibration);
}

TEST(ArmReport, FindsTheSwitchInTheFirstCountOfTheStylus) {
    // 10 000 - 300 = 9700 = 0x25E4
    const std::array<std::uint8_t, 14> report{0, 0, 0, 0, 0, 0, 0xE4, 0x25, 0, 0, 0, 0, 0, 0};
    const auto input = decode_arm_report(report);
    ASSERT_TRUE(input);
    EXPECT_TRUE(input->is_switch_pressed);
    EXPECT_EQ(input->stylus_counts[0], -300);
}

TEST(ArmReport, KnowsTheFirstGenerationByItsLength) {
    const std::array<std::uint8_t, 8> report{1, 0, 2, 0, 0xFD, 0xFF, 99, 99};
    const auto input = decode_arm_report(report);
    ASSERT_TRUE(input);
    EXPECT_EQ(input->generation, ArmGeneration::first);
    EXPECT_THAT(input->arm_counts, ElementsAre(1, 2, -3));
    EXPECT_FALSE(input->asks_for_calibration);
}

TEST(ArmReport, RefusesEveryOtherLengthAndAnInfoThatMeansNothing) {
    const std::array<std::uint8_t, 64> zeros{};
    for (std::size_t size = 0; size <= zeros.size(); ++size) {
        const bool is_known = size == 8 || size == 14;
        EXPECT_EQ(decode_arm_report({zeros.data(), size}).has_value(), is_known) << size;
    }
    std::array<std::uint8_t, 14> report{};
    report[12] = 2;
    EXPECT_FALSE(decode_arm_report(report));
}

TEST(ArmReport, WritesCurrentsBehindAZeroByteAndCapsThem) {
    // 0x0102, -2, 1999 = 0x07CF
    EXPECT_THAT(bytes_of(currents_report(ArmGeneration::second, {0x0102, -2, 30'000})),
                ElementsAre(0, 0x02, 0x01, 0xFE, 0xFF, 0xCF, 0x07, 0, 0, 0, 0, 0, 0, 0, 0));
    // -1999 = 0xF831
    EXPECT_THAT(bytes_of(currents_report(ArmGeneration::first, {-40'000, 0, 0})),
                ElementsAre(0, 0x31, 0xF8, 0, 0, 0, 0, 0, 0));
}

TEST(ArmReport, SetsTheCountersByCommandOneWithoutCurrent) {
    // 6000 = 0x1770
    EXPECT_THAT(bytes_of(counters_report({0, -1, 6000})),
                ElementsAre(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0xFF, 0xFF, 0x70, 0x17));
}

}  // namespace
}  // namespace osteomill
