#include "common/program/available_memory.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

TEST(AvailableMemory, IsReadFromWhatTheKernelSays) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "meminfo") << "MemTotal:  100 kB\nMemAvailable:   24 kB\n";
    EXPECT_EQ(available_memory_bytes(folder / "meminfo"), 24u * 1024u);
    std::ofstream(folder / "none") << "MemTotal: 100 kB\n";
    EXPECT_EQ(available_memory_bytes(folder / "none"), std::nullopt);
    EXPECT_EQ(available_memory_bytes(folder / "no file"), std::nullopt);
}

}  // namespace
}  // namespace osteomill
