#include "render_client/ui/start/loose_parts.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

/// 20 x 20 x 20 voxels of 0.5 mm about a corner at -1, -2, -3 mm: greys are HU / 10.
struct Scan {
    ScanVoxels voxels{.size = {20, 20, 20}, .greys = std::vector<std::uint8_t>(8000), .segments = {}};
    ScanPreview look{.covers = {{-1.0, -2.0, -3.0}, {8.5, 7.5, 6.5}}, .black_hu = 0.0, .white_hu = 2550.0};

    void fill(const glm::ivec3& low, const glm::ivec3& high, std::uint8_t grey) {
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    voxels.greys[static_cast<std::size_t>(x + 20 * (y + 20 * z))] = grey;
    }
    LooseParts loose(double threshold_hu) const { return loose_in(look.covers, threshold_hu); }
    LooseParts loose_in(const ScanBox& region, double threshold_hu) const {
        return loose_parts_in(voxels, look, 0.5, region, threshold_hu);
    }
};

TEST(LooseParts, AreSmallAndTouchNothingElse) {
    Scan scan;
    EXPECT_EQ(scan.loose(300.0), LooseParts{});
    scan.fill({0, 0, 0}, {5, 5, 5}, 100);
    EXPECT_EQ(scan.loose(300.0), LooseParts{}) << "bone";
    scan.fill({6, 6, 6}, {6, 6, 6}, 100);
    EXPECT_EQ(scan.loose(300.0), LooseParts{}) << "touches it at a corner";
    scan.fill({10, 10, 10}, {10, 10, 11}, 40);
    scan.fill({19, 19, 19}, {19, 19, 19}, 100);
    EXPECT_EQ(scan.loose(300.0), (LooseParts{2, 3 * 0.125}));
    EXPECT_EQ(scan.loose(500.0), (LooseParts{1, 0.125})) << "the other one is below the threshold";
    scan.fill({10, 10, 10}, {11, 11, 13}, 100);
    EXPECT_EQ(scan.loose(300.0), (LooseParts{1, 0.125})) << "2 mm3 are no speck";
}

TEST(LooseParts, AreThoseOfTheRegionAndNeverTheLargest) {
    Scan scan;
    scan.fill({0, 0, 0}, {0, 0, 1}, 100);
    scan.fill({10, 0, 0}, {10, 0, 0}, 100);
    EXPECT_EQ(scan.loose(300.0), (LooseParts{1, 0.125})) << "the larger is the bone";
    EXPECT_EQ(scan.loose_in({{-1.0, -2.0, -3.0}, {3.5, 7.5, 6.5}}, 300.0), LooseParts{});
    EXPECT_EQ(scan.loose_in({{-9.0, -9.0, -9.0}, {99.0, 99.0, 99.0}}, 300.0), (LooseParts{1, 0.125}));
    scan.look.white_hu = 0.0;
    EXPECT_EQ(scan.loose(300.0), LooseParts{}) << "the preview does not say its HU";
}

}  // namespace
}  // namespace osteomill
