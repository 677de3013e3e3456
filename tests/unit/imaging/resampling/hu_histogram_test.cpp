#include "imaging/resampling/hu_histogram.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// Air, soft tissue and bone with noise, as a scanner gives them, in an image that stores HU + `offset`.
std::vector<float> scan(float offset) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0.0F, 25.0F);
    std::vector<float> values;
    for (int i = 0; i < 30'000; ++i) {
        const float tissue = i % 3 == 0 ? -1000.0F : (i % 3 == 1 ? 40.0F : 1200.0F);
        values.push_back(std::round(std::max(tissue + noise(random), -1024.0F)) + offset);
    }
    return values;
}

std::string doubt_of(const std::vector<float>& values) {
    HuHistogram histogram;
    histogram.add(values);
    return histogram.doubt();
}

TEST(HuHistogram, DoubtsNoScanThatIsInHu) {
    EXPECT_EQ(doubt_of(scan(0.0F)), "");
}

TEST(HuHistogram, DoubtsNoBoneWithoutAirAroundIt) {
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(700 + i));
    EXPECT_EQ(doubt_of(values), "");
}

TEST(HuHistogram, TellsAScanThatLacksItsOffset) {
    EXPECT_THAT(doubt_of(scan(1024.0F)), HasSubstr("33 % are near 0, as where air is stored as 0"));
    EXPECT_THAT(doubt_of(scan(1000.0F + 24.0F)), HasSubstr("--rescale 1,-1024"));
}

TEST(HuHistogram, TellsAScanWithAnOffsetOf1000) {
    EXPECT_THAT(doubt_of(scan(1000.0F)), HasSubstr("nothing is below -24 and 33 % are near 0"));
    std::vector<float> padded = scan(1000.0F);
    padded.insert(padded.end(), 2000, -1000.0F);  // outside the field of view: -2000, and the offset
    EXPECT_THAT(doubt_of(padded), HasSubstr("nothing is below -24 but the constant -1000 of 6 %"));
    std::vector<float> right = scan(0.0F);
    right.insert(right.end(), 2000, -3024.0F);
    EXPECT_EQ(doubt_of(right), "");
}

TEST(HuHistogram, DoubtsNoHeadThatWasCutOutOfItsAir) {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.0F, 12.0F);
    std::vector<float> values;
    for (int i = 0; i < 30'000; ++i)
        values.push_back(std::round((i % 4 == 0 ? 1400.0F : 35.0F) + noise(random)));
    EXPECT_EQ(doubt_of(values), "");
}

TEST(HuHistogram, TakesAConstantOfMinus1000ForAir) {
    for (const float lowest_tissue : {40.0F, 0.0F, -80.0F}) {
        std::vector<float> values(7000, -1000.0F);
        for (int i = 0; i < 3000; ++i)
            values.push_back(i % 10 == 0 ? 1500.0F : lowest_tissue + static_cast<float>(i % 40));
        EXPECT_EQ(doubt_of(values), "") << lowest_tissue;
    }
}

TEST(HuHistogram, TellsTheConstantAroundAFieldOfView) {
    const auto fill_of = [](float fill) {
        std::vector<float> values = scan(0.0F);
        values.insert(values.end(), 2000, fill);
        HuHistogram histogram;
        histogram.add(values);
        return histogram.fill_hu();
    };
    for (const float fill : {-1500.0F, -2000.0F, -3024.0F, -32768.0F}) EXPECT_EQ(fill_of(fill), fill);
    EXPECT_EQ(fill_of(-1024.0F), std::nullopt) << "air";
    EXPECT_EQ(fill_of(NAN), std::nullopt);
}

TEST(HuHistogram, TakesTheVoxelsOfABoneFileAsWell) {
    HuHistogram histogram;
    EXPECT_EQ(histogram.highest_hu(), -4096);
    const std::vector<std::int16_t> values{0, 3, 3, 1, -32768};
    histogram.add(std::span(values).first(4));
    EXPECT_EQ(histogram.highest_hu(), 3);
    EXPECT_THAT(histogram.doubt(), HasSubstr("3 whole numbers from 0 to 3, as of a label map"));
    histogram.add(values);
    EXPECT_EQ(histogram.doubt(), "");
}

TEST(HuHistogram, TellsALabelMap) {
    EXPECT_THAT(doubt_of({0, 0, 1, 2, 2, 5}),
                HasSubstr("its values are 4 whole numbers from 0 to 5, as of a label map"));
}

TEST(HuHistogram, TellsAPictureOfEightBits) {
    std::vector<float> values;
    for (int i = 0; i < 256; ++i) values.push_back(static_cast<float>(i));
    EXPECT_THAT(doubt_of(values), HasSubstr("from 0 to 255, as of a picture of 8 bits"));
}

TEST(HuHistogram, HasNoOpinionOfOneValueOrNone) {
    EXPECT_EQ(doubt_of({}), "");
    EXPECT_EQ(doubt_of({0, 0, 0}), "");
}

TEST(HuHistogram, TakesWhatIsBeyondItsEnds) {
    EXPECT_THAT(doubt_of({-1e30F, 1e30F}), HasSubstr("lie at 8191 and above"));
    EXPECT_EQ(doubt_of({-1e30F, -1000, 0, 40, 400, 1e30F}), "") << "metal";
}

TEST(HuHistogram, TellsAttenuationFromHu) {
    EXPECT_THAT(doubt_of({-0.014F, 0.0F, 0.02F, 0.34F}), HasSubstr("fractions that all round to 0"));
}

}  // namespace
}  // namespace osteomill
