#include "haptic_server/milling/sweep.h"

#include <gtest/gtest.h>

#include <random>

namespace osteomill {
namespace {

TEST(Sweep, LineThroughACapsuleIsWhereItsPointsAreWithinTheRadius) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-4.0, 4.0);
    for (int trial = 0; trial < 300; ++trial) {
        Sweep sweep{{place(random), place(random), place(random)},
                    {place(random), place(random), place(random)},
                    2.5};
        if (trial % 5 == 0) sweep.to.x = sweep.from.x;                            // across the line
        if (trial % 7 == 0) sweep.to = {sweep.to.x, sweep.from.y, sweep.from.z};  // along it
        if (trial % 11 == 0) sweep.to = sweep.from;                               // a ball
        const double y = place(random);
        const double z = place(random);
        const Interval hit = line_through_sweep(sweep, y, z);
        for (double x = -12.0; x <= 12.0; x += 0.01) {
            const double margin = distance_to_path(sweep, {x, y, z}) - sweep.radius;
            if (std::abs(margin) < 1e-6) continue;
            EXPECT_EQ(margin < 0.0, hit.first <= x && x <= hit.last) << "trial " << trial << " at x = " << x;
        }
    }
}

TEST(Sweep, VolumeIsThatOfACapsule) {
    constexpr double pi = 3.14159265358979323846;
    EXPECT_NEAR(volume({{0, 0, 0}, {0, 3, 4}, 1.0}), pi * (4.0 / 3.0 + 5.0), 1e-12);
}

}  // namespace
}  // namespace osteomill
