#include "simulation/exchange/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace osteomill {
namespace {

TEST(TripleBuffer, HasNothingNewBeforeTheFirstPublication) {
    TripleBuffer<int> buffer;
    EXPECT_FALSE(buffer.refresh());
    EXPECT_EQ(buffer.front(), 0);
}

TEST(TripleBuffer, HoldsWhatItWasMadeWithUntilThen) {
    TripleBuffer<int> buffer(7);
    EXPECT_FALSE(buffer.refresh());
    EXPECT_EQ(buffer.front(), 7);
}

TEST(TripleBuffer, HandsOverTheLatestAndSkipsWhatLiesBetween) {
    TripleBuffer<int> buffer;
    for (int i = 1; i <= 5; ++i) {
        buffer.back() = i;
        buffer.publish();
    }
    EXPECT_TRUE(buffer.refresh());
    EXPECT_EQ(buffer.front(), 5);
    EXPECT_FALSE(buffer.refresh());
    EXPECT_EQ(buffer.front(), 5);
}

TEST(TripleBuffer, NeverShowsAHalfWrittenOrOlderValueToAnotherThread) {
    using Value = std::array<std::uint64_t, 64>;
    TripleBuffer<Value> buffer;
    constexpr std::uint64_t last = 100'000;
    std::thread writer([&] {
        for (std::uint64_t i = 1; i <= last; ++i) {
            buffer.back().fill(i);
            buffer.publish();
        }
    });
    std::uint64_t seen = 0;
    bool is_whole = true;
    bool is_ordered = true;
    while (seen < last) {
        if (!buffer.refresh()) continue;
        const Value& value = buffer.front();
        for (const std::uint64_t part : value) is_whole &= part == value[0];
        is_ordered &= value[0] > seen;
        seen = value[0];
    }
    writer.join();
    EXPECT_TRUE(is_whole);
    EXPECT_TRUE(is_ordered);
}

}  // namespace
}  // namespace osteomill
