#include "imaging/memory_estimate.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(MemoryEstimate, DoesNotGrowWithTheResult) {
    const Grid one_slice{.size_voxels = {2400, 2400, 1}, .spacing_mm = 0.1, .origin_mm = {}};
    const Grid head{.size_voxels = {2400, 2400, 2000}, .spacing_mm = 0.1, .origin_mm = {}};
    EXPECT_EQ(import_memory_bytes(512 * 512, 40'000'000, head),
              import_memory_bytes(512 * 512, 40'000'000, one_slice));
    EXPECT_LT(import_memory_bytes(512 * 512, 40'000'000, head), most_import_bytes);
}

TEST(MemoryEstimate, StaysBelowItsLimitForLargeScansAndWideSlices) {
    const Grid body{.size_voxels = {5000, 5000, 20000}, .spacing_mm = 0.1, .origin_mm = {}};
    EXPECT_LT(import_memory_bytes(1024 * 1024, 4'000'000'000, body), most_import_bytes);
    EXPECT_GE(slices_at_once(body), 1);
}

TEST(MemoryEstimate, CountsWhatReadingHolds) {
    EXPECT_GE(import_memory_bytes(8'000'000'000, 1000, Grid{.size_voxels = {1, 1, 1}}), 8'000'000'000u);
}

}  // namespace
}  // namespace osteomill
