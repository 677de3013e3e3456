#include "common/log/text_writer.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <vector>

#include "tests/support/eventually.h"
#include "tests/support/unread_pipe.h"

namespace osteomill {
namespace {

using testing::eventually;
using testing::UnreadPipe;

constexpr std::size_t capacity_bytes = 100;

TEST(TextWriter, WritesAllInOrderAlsoToADescriptorThatItsOwnerCloses) {
    UnreadPipe pipe;
    TextWriter writer(pipe.writer(), capacity_bytes);
    pipe.close_writer();
    EXPECT_TRUE(writer.push("one "));
    EXPECT_TRUE(writer.push("two "));
    writer.wait_until_written();
    EXPECT_EQ(pipe.read(100), "one two ");
    EXPECT_TRUE(writer.push("three"));
    EXPECT_TRUE(writer.finish());
    EXPECT_EQ(pipe.read(100), "three");
    EXPECT_EQ(writer.error(), "");
}

TEST(TextWriter, NeverWaitsForAPipeThatNobodyReadsAndHoldsNoMoreThanItMay) {
    const UnreadPipe pipe;
    pipe.fill();
    TextWriter writer(pipe.writer(), capacity_bytes);
    int taken = 0;
    while (writer.push("ten bytes\n")) ++taken;
    EXPECT_EQ(taken, 10);
    EXPECT_FALSE(writer.is_idle());

    pipe.read(70'000);
    EXPECT_TRUE(eventually([&] { return writer.is_idle(); }));
    EXPECT_TRUE(writer.push("ten bytes\n"));
    EXPECT_TRUE(writer.finish());
    EXPECT_EQ(pipe.read(200).size(), 110U);
}

TEST(TextWriter, TakesATextLongerThanItsCapacityWhereNothingElseWaits) {
    const UnreadPipe pipe;
    TextWriter writer(pipe.writer(), capacity_bytes);
    EXPECT_TRUE(writer.push(std::string(1000, 'x')));
    EXPECT_TRUE(writer.finish());
    EXPECT_EQ(pipe.read(2000).size(), 1000U);
}

TEST(TextWriter, IsDoneAfterABoundedTimeWithAThreadThatIsStillBlocked) {
    const UnreadPipe pipe;
    pipe.fill();
    {
        TextWriter writer(pipe.writer(), capacity_bytes);
        EXPECT_TRUE(writer.push("never"));
        EXPECT_FALSE(writer.finish());
        EXPECT_TRUE(writer.push("forgotten"));
    }
    // The thread that was left behind goes on as soon as it can, although its owner has gone.
    pipe.read(70'000);
    EXPECT_EQ(pipe.read(100), "never");
}

TEST(TextWriter, GivesUpADescriptorThatFails) {
    std::signal(SIGPIPE, SIG_IGN);
    UnreadPipe pipe;
    pipe.close_reader();
    TextWriter writer(pipe.writer(), capacity_bytes);
    EXPECT_TRUE(writer.push("nobody reads this"));
    writer.wait_until_written();
    EXPECT_EQ(writer.error(), std::strerror(EPIPE));
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(writer.push("ten bytes\n")) << "forgotten";
    EXPECT_TRUE(writer.finish());
}

TEST(TextWriter, TakesAClosedDescriptorForOneThatFails) {
    TextWriter writer(-1, capacity_bytes);
    EXPECT_EQ(writer.error(), std::strerror(EBADF));
    EXPECT_TRUE(writer.push("forgotten"));
    EXPECT_TRUE(writer.finish());
}

TEST(TextWriter, TakesWhatManyThreadsSayWhole) {
    const UnreadPipe pipe;
    {
        TextWriter writer(pipe.writer(), 65'536);
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&writer] {
                for (int line = 0; line < 100; ++line) EXPECT_TRUE(writer.push("ten bytes\n"));
            });
        for (std::thread& thread : threads) thread.join();
    }
    const std::string text = pipe.read(65'536);
    ASSERT_EQ(text.size(), 4000U);
    for (std::size_t i = 0; i < text.size(); i += 10) ASSERT_EQ(text.substr(i, 10), "ten bytes\n");
}

}  // namespace
}  // namespace osteomill
