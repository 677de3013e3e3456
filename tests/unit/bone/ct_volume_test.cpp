#include "common/bone/ct_volume.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(CtVolume, IsLinearBetweenVoxelsAndAirBeyondThem) {
    CtVolume ct{.grid = {.size_voxels = {4, 3, 2}, .spacing_mm = 0.5, .origin_mm = {1.0, 2.0, 3.0}},
                .hu = {}};
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 4; ++x) ct.hu.push_back(static_cast<std::int16_t>(100 * x - 10 * y + 7 * z));
    EXPECT_DOUBLE_EQ(ct.hu_at({1.0, 2.0, 3.0}), 0.0);
    EXPECT_DOUBLE_EQ(ct.hu_at({2.5, 3.0, 3.5}), 300.0 - 20.0 + 7.0);
    EXPECT_NEAR(ct.hu_at({1.6, 2.35, 3.2}), 100.0 * 1.2 - 10.0 * 0.7 + 7.0 * 0.4, 1e-9);
    EXPECT_DOUBLE_EQ(ct.hu_at({0.0, 2.0, 3.0}), -1000.0);
    EXPECT_NEAR(ct.hu_at({0.75, 2.0, 3.0}), -500.0, 1e-9) << "halfway to air";
}

}  // namespace
}  // namespace osteomill
