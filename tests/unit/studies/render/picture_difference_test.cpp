#include "studies/render/picture_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace osteomill::study {
namespace {

Picture noise(std::uint32_t seed) {
    Picture picture({40, 30});
    for (std::uint8_t& byte : picture.rgb) {
        seed = seed * 1664525u + 1013904223u;
        byte = static_cast<std::uint8_t>(seed >> 24);
    }
    return picture;
}

TEST(PictureDifference, IsNoneForEqualPictures) {
    EXPECT_TRUE(std::isinf(psnr_db(noise(1), noise(1))));
    EXPECT_DOUBLE_EQ(ssim(noise(1), noise(1)), 1.0);
}

TEST(PictureDifference, CountsAnOffsetOfOneLevelAs48Decibels) {
    Picture grey({40, 30}), lighter({40, 30});
    std::fill(grey.rgb.begin(), grey.rgb.end(), std::uint8_t{100});
    std::fill(lighter.rgb.begin(), lighter.rgb.end(), std::uint8_t{101});
    EXPECT_NEAR(psnr_db(lighter, grey), 20.0 * std::log10(255.0), 1e-9);
    // Without structure only the means are compared.
    const double c1 = 2.55 * 2.55;
    EXPECT_NEAR(ssim(lighter, grey), (2.0 * 100.0 * 101.0 + c1) / (100.0 * 100.0 + 101.0 * 101.0 + c1), 1e-9);
}

TEST(PictureDifference, TellsNoiseFromStructure) {
    EXPECT_LT(psnr_db(noise(1), noise(2)), 10.0);
    EXPECT_LT(ssim(noise(1), noise(2)), 0.2);
}

TEST(PictureDifference, RefusesPicturesOfDifferentSizes) {
    EXPECT_THROW(psnr_db(Picture({2, 2}), Picture({2, 3})), std::invalid_argument);
    EXPECT_THROW(ssim(Picture({2, 2}), Picture({2, 3})), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study
