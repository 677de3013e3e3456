#include "haptic_server/imaging/memory_estimate.h"

#include <gtest/gtest.h>

#include <sstream>

namespace osteomill {
namespace {

TEST(MemoryEstimate, CountsTheResultAndWhatRefiningHolds) {
    const Grid result{.size_voxels = {1000, 1000, 1000}, .spacing_mm = 0.1, .origin_mm = {}};
    EXPECT_GE(import_memory_bytes(1000, 1000, result), 2'000'000'000u);
    EXPECT_GE(import_memory_bytes(1'000'000'000, 1000, Grid{.size_voxels = {1, 1, 1}}), 8'000'000'000u);
}

TEST(MemoryEstimate, ReadsWhatIsAvailable) {
    std::istringstream meminfo("MemTotal:  100 kB\nMemAvailable:   24 kB\n");
    EXPECT_EQ(available_memory_bytes(meminfo), 24u * 1024u);
    std::istringstream none("MemTotal: 100 kB\n");
    EXPECT_EQ(available_memory_bytes(none), std::nullopt);
}

}  // namespace
}  // namespace osteomill
