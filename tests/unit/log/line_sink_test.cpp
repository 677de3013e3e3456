#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include "common/log/line_stream.h"
#include "tests/support/unread_pipe.h"

namespace osteomill {
namespace {

using ::testing::MatchesRegex;
using testing::UnreadPipe;

TEST(LineSink, WritesWhatIsLoggedWithTimeProgramAndLevel) {
    const UnreadPipe pipe;
    const auto stream = std::make_shared<LineStream>(pipe.writer());
    log_to(stream, "haptic_server");
    spdlog::warn("client {} left", 7);
    stream->finish();
    EXPECT_THAT(pipe.read(1000),
                MatchesRegex("\\[[-0-9]+ [:.0-9]+\\] \\[haptic_server\\] \\[warning\\] client 7 left\n"));
}

TEST(LineSink, NeitherWaitsNorFailsWhereNobodyReads) {
    const UnreadPipe pipe;
    pipe.fill();
    const auto stream = std::make_shared<LineStream>(pipe.writer(), 1000);
    log_to(stream, "haptic_server");
    for (int i = 0; i < 1000; ++i) spdlog::info("a line of the log that nobody reads");
    stream->finish();
    spdlog::info("what comes later is forgotten");
}

}  // namespace
}  // namespace osteomill
