#include "imaging/resampling/intensity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace osteomill {
namespace {

TEST(Intensity, RescalesLinearly) {
    std::array values{0.0F, 100.0F};
    rescale_values(parse_rescale("2,-1000"), values);
    EXPECT_EQ(values, (std::array{-1000.0F, -800.0F}));
}

TEST(Intensity, WindowMapsLowToSoftTissueAndHighToDenseBone) {
    std::array values{10.0F, 80.0F, 150.0F, 220.0F, 255.0F};
    window_values(parse_intensity_window("80,220"), values);
    EXPECT_EQ(values, (std::array{0.0F, 0.0F, 1000.0F, 2000.0F, 2000.0F}));
}

TEST(Intensity, RefusesTextsThatAreNotTwoNumbers) {
    for (const char* wrong : {"", "1", "1,", ",1", "1,2,3", "a,b", "nan,1", "1;2"}) {
        EXPECT_THROW(parse_rescale(wrong), std::invalid_argument) << wrong;
        EXPECT_THROW(parse_intensity_window(wrong), std::invalid_argument) << wrong;
    }
    EXPECT_THROW(parse_rescale("0,1"), std::invalid_argument);
    EXPECT_THROW(parse_intensity_window("5,5"), std::invalid_argument);
}

TEST(Intensity, TakesWhatIsInfiniteForNotMeasured) {
    std::array values{1.0F, NAN, INFINITY};
    EXPECT_EQ(mark_not_finite(values), 2u);
    EXPECT_EQ(values[0], 1.0F);
    EXPECT_TRUE(std::isnan(values[1]) && std::isnan(values[2]));
}

}  // namespace
}  // namespace osteomill
