#include "haptic_server/program/status_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace osteomill {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// Collects what a status line writes.
class Paper {
  public:
    std::FILE* file() { return file_.get(); }
    std::string text() {
        std::fflush(file_.get());
        std::rewind(file_.get());
        std::string result;
        for (int c = std::fgetc(file_.get()); c != EOF; c = std::fgetc(file_.get())) {
            result.push_back(static_cast<char>(c));
        }
        return result;
    }

  private:
    struct Close {
        void operator()(std::FILE* f) const { std::fclose(f); }
    };
    std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
};

ToolSnapshot tool_at(double time_s, Fault fault = Fault::none) {
    ToolSnapshot tool;
    tool.time_s = time_s;
    tool.fault = fault;
    return tool;
}

long lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(StatusLine, AddsALineEveryFiveSecondsWhereThereIsNoTerminal) {
    Paper paper;
    StatusLine status(paper.file(), false);
    const StatusLine::Clock::time_point start{};
    for (int i = 0; i <= 120; ++i) status.show(tool_at(0.1 * i), start + milliseconds(100 * i));
    EXPECT_EQ(lines(paper.text()), 3);
}

TEST(StatusLine, RewritesOneLineOnATerminal) {
    Paper paper;
    StatusLine status(paper.file(), true);
    const StatusLine::Clock::time_point start{};
    for (int i = 0; i <= 30; ++i) status.show({}, start + milliseconds(100 * i));
    status.finish();
    const std::string text = paper.text();
    EXPECT_EQ(lines(text), 1);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 4);
}

TEST(StatusLine, ShowsForceAndRemovedBone) {
    Paper paper;
    StatusLine status(paper.file(), false);
    ToolSnapshot tool = tool_at(1.5);
    tool.spindle_on = true;
    tool.force_n = {0.0, 0.6, 0.8};
    tool.removed_mm3 = 12.5;
    status.show(tool, {});
    EXPECT_THAT(paper.text(), HasSubstr("force  1.00 N   removed    12.50 mm^3   spindle on"));
}

TEST(StatusLine, SaysAtOnceWhenTheForceGoesOffAndComesBack) {
    Paper paper;
    StatusLine status(paper.file(), false);
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
    StatusLine status(paper.file(), false);
    status.show_notice(tool_at(0.0), "");
    status.show_notice(tool_at(1.0), "plug it in again");
    status.show_notice(tool_at(2.0), "plug it in again");
    status.show_notice(tool_at(3.0), "");
    EXPECT_EQ(paper.text(), "    1.0 s   plug it in again\n    3.0 s   the device is ready\n");
}

}  // namespace
}  // namespace osteomill
