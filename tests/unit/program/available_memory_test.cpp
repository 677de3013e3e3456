#include "common/program/available_memory.h"

#include <gtest/gtest.h>

#include <sstream>

namespace osteomill {
namespace {

TEST(AvailableMemory, IsReadFromWhatTheKernelSays) {
    std::istringstream meminfo("MemTotal:  100 kB\nMemAvailable:   24 kB\n");
    EXPECT_EQ(available_memory_bytes(meminfo), 24u * 1024u);
    std::istringstream none("MemTotal: 100 kB\n");
    EXPECT_EQ(available_memory_bytes(none), std::nullopt);
}

}  // namespace
}  // namespace osteomill
