#include "haptic_server/program/resident_memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace osteomill {
namespace {

TEST(PeakResidentBytes, AreReadFromTheSystemsText) {
    std::istringstream status(
        "Name:\thaptic server\nVmPeak:\t  999999 kB\nVmHWM:\t    1234 kB\nVmRSS:\t 99 kB\n");
    EXPECT_EQ(peak_resident_bytes(status), 1234U * 1024U);
}

TEST(PeakResidentBytes, AreUnknownWhereTheTextLacksThem) {
    std::istringstream status("Name:\tVmHWM: 5 kB\nVmHWM:\tmany kB\n");
    EXPECT_EQ(peak_resident_bytes(status), std::nullopt);
}

TEST(PeakResidentBytes, OfThisProgramAreAtLeastWhatItUses) {
    std::ifstream status("/proc/self/status");
    const std::vector<char> used(std::size_t{8} << 20U, 'x');
    EXPECT_GE(peak_resident_bytes(status).value_or(0), used.size());
}

}  // namespace
}  // namespace osteomill
