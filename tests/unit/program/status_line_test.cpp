#include "haptic_server/program/status_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>

#include "simulation/safety/fault.h"
#include "tests/support/unread_pipe.h"

namespace osteomill {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// Collects a status line's output.
class Paper {
  public:
    LineStream& stream() { return stream_; }
    /// Until all is on it.
    void wait() const {
        while (!stream_.has_caught_up()) std::this_thread::yield();
    }
    /// The text since the last call; there must be some.
    std::string text() const {
        wait();
        return pipe_.read(65'536);
    }
    const testing::UnreadPipe& pipe() const { return pipe_; }

  private:
    testing::UnreadPipe pipe_;
    LineStream stream_{pipe_.writer()};
};

ToolState tool_at(double time_s, Fault fault = Fault::none) {
    ToolState tool;
    tool.time_s = time_s;
    tool.fault = describe(fault);
    return tool;
}

long lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(StatusLine, AddsALineEveryFiveSecondsWhereThereIsNoTerminal) {
    Paper paper;
    StatusLine status(paper.stream(), false);
    const StatusLine::Clock::time_point start{};
    for (int i = 0; i <= 120; ++i) {
        status.show(tool_at(0.1 * i), start + milliseconds(100 * i));
        paper.wait();
    }
    EXPECT_EQ(lines(paper.text()), 3);
}

TEST(StatusLine, SaysHowMuchIsDoneOfASessionThatRunsAsFastAsItCan) {
    for (const bool is_terminal : {false, true}) {
        Paper paper;
        StatusLine status(paper.stream(), is_terminal);
        const StatusLine::Clock::time_point start{};
        std::string text;
        for (int i = 0; i <= 200; ++i) {
            status.show(tool_at(0.1 * i), start + milliseconds(i), i / 200.0);
            paper.wait();
        }
        text = paper.text();
        const char shown = is_terminal ? '\r' : '\n';
        EXPECT_EQ(std::count(text.begin(), text.end(), shown), 11) << text;
        EXPECT_THAT(text, HasSubstr("10.0 s (50 %)"));
        EXPECT_THAT(text, HasSubstr("20.0 s (100 %)"));
    }
}

TEST(StatusLine, SaysOnceWhatAChangeOfBurrWaitsFor) {
    Paper paper;
    StatusLine status(paper.stream(), false);
    const StatusLine::Clock::time_point start{};
    ToolState tool = tool_at(1.0);
    tool.notice = "the burr is changed in the air";
    for (int i = 0; i < 20; ++i) {
        status.show(tool, start + milliseconds(100 * i));
        paper.wait();
    }
    const std::string text = paper.text();
    EXPECT_THAT(text, HasSubstr("changed in the air"));
    EXPECT_EQ(lines(text), 2) << "and the first status line";
}

TEST(StatusLine, RewritesOneLineOnATerminal) {
    Paper paper;
    StatusLine status(paper.stream(), true);
    const StatusLine::Clock::time_point start{};
    for (int i = 0; i <= 30; ++i) {
        status.show({}, start + milliseconds(100 * i));
        paper.wait();
    }
    status.finish();
    const std::string text = paper.text();
    EXPECT_EQ(lines(text), 1);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 4);
}

TEST(StatusLine, SaysNothingOldWhenATerminalThatStoodStillGoesOn) {
    Paper paper;
    StatusLine status(paper.stream(), true);
    const StatusLine::Clock::time_point start{};
    paper.pipe().fill();
    for (int i = 0; i <= 100; ++i) status.show(tool_at(0.1 * i), start + milliseconds(100 * i));
    while (paper.pipe().read(65'536).empty()) {
    }
    paper.wait();
    status.show(tool_at(11.0), start + milliseconds(11'000));
    const std::string text = paper.text();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 1);
    EXPECT_THAT(text, HasSubstr("11.0 s"));
}

TEST(StatusLine, ShowsForceAndRemovedBone) {
    Paper paper;
    StatusLine status(paper.stream(), false);
    ToolState tool = tool_at(1.5);
    tool.spindle_on = true;
    tool.force_n = {0.0, 0.6, 0.8};
    tool.removed_mm3 = 12.5;
    status.show(tool, {});
    EXPECT_THAT(paper.text(), HasSubstr("force  1.00 N   removed    12.50 mm^3   spindle on"));
}

TEST(StatusLine, SaysAtOnceWhenTheForceGoesOffAndComesBack) {
    Paper paper;
    StatusLine status(paper.stream(), false);
    const StatusLine::Clock::time_point start{};
    status.show({}, start);
    status.show(tool_at(0.0, Fault::model_stalled), start + milliseconds(20));
    status.show(tool_at(0.0, Fault::model_stalled), start + milliseconds(40));
    status.show({}, start + milliseconds(60));
    const std::string text = paper.text();
    EXPECT_EQ(lines(text), 3);
    EXPECT_THAT(text, HasSubstr(describe(Fault::model_stalled)));
    EXPECT_THAT(text, HasSubstr("comes back"));
}

TEST(StatusLine, TellsWhatTheDeviceSaysOfItselfOnce) {
    Paper paper;
    StatusLine status(paper.stream(), false);
    status.show_notice(tool_at(0.0), "");
    status.show_notice(tool_at(1.0), "plug it in again");
    status.show_notice(tool_at(2.0), "plug it in again");
    status.show_notice(tool_at(3.0), "");
    EXPECT_EQ(paper.text(), "    1.0 s   plug it in again\n    3.0 s   the device is ready\n");
}

}  // namespace
}  // namespace osteomill
