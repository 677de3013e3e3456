#include "common/log/line_stream.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <ostream>
#include <thread>

#include "tests/support/eventually.h"
#include "tests/support/unread_pipe.h"

namespace osteomill {
namespace {

using testing::eventually;
using ::testing::HasSubstr;
using testing::UnreadPipe;

TEST(LineStream, SaysHowManyLinesItDroppedAsSoonAsThereIsRoom) {
    const UnreadPipe pipe;
    pipe.fill();
    LineStream stream(pipe.writer(), 100);
    for (int i = 0; i < 17; ++i) stream.write("ten bytes\n");
    EXPECT_FALSE(stream.has_caught_up());
    pipe.read(70'000);
    EXPECT_TRUE(eventually([&] { return stream.has_caught_up(); }));
    stream.write("and on\n");
    stream.finish();
    const std::string text = pipe.read(1000);
    EXPECT_THAT(text, HasSubstr("ten bytes\n(7 lines are missing here: nobody took them)\nand on\n"));
}

TEST(LineStream, SaysSoAtTheEndIfNotBefore) {
    const UnreadPipe pipe;
    pipe.fill();
    LineStream stream(pipe.writer(), 100);
    for (int i = 0; i < 11; ++i) stream.write("ten bytes\n");
    pipe.read(70'000);
    EXPECT_TRUE(eventually([&] { return stream.has_caught_up(); }));
    stream.finish();
    EXPECT_THAT(pipe.read(1000), HasSubstr("ten bytes\n(1 lines are missing here"));
}

TEST(LineStreamBuffer, HandsOnWhatIsFlushed) {
    const UnreadPipe pipe;
    LineStream stream(pipe.writer());
    {
        LineStreamBuffer buffer(stream);
        std::ostream text(&buffer);
        text << "ten"
             << " bytes" << std::endl;
        while (!stream.has_caught_up()) std::this_thread::yield();
        EXPECT_EQ(pipe.read(100), "ten bytes\n");
        text << "the rest";
    }
    stream.finish();
    EXPECT_EQ(pipe.read(100), "the rest");
}

TEST(LineStream, IsSilentAboutAStreamThatCannotBeWrittenTo) {
    const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    if (full < 0) GTEST_SKIP() << "there is no /dev/full here";
    LineStream stream(full, 100);
    ::close(full);
    for (int i = 0; i < 1000; ++i) stream.write("ten bytes\n");
    EXPECT_TRUE(eventually([&] { return stream.has_caught_up(); }));
    stream.finish();
}

}  // namespace
}  // namespace osteomill
