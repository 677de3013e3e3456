#include "common/program/progress.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace osteomill {
namespace {

TEST(Progress, SaysEveryTenthInALogAndNothingTwice) {
    std::ostringstream out;
    {
        ProgressLine line(out, false, "refining");
        for (int i = 0; i <= 1000; ++i) line.report(i / 1000.0);
        line.report(0.5);
    }
    const std::string text = out.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
    EXPECT_THAT(text, ::testing::StartsWith("refining 10 %\n"));
    EXPECT_THAT(text, ::testing::EndsWith("refining 100 %\n"));
}

TEST(Progress, DrawsOneBarOnATerminal) {
    std::ostringstream out;
    {
        ProgressLine line(out, true, "refining");
        line.report(0.5);
        line.report(1.0);
    }
    const std::string text = out.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    EXPECT_THAT(text, ::testing::HasSubstr("\rrefining   [####################                    ]  50 %"));
}

/// A line whose clock the test moves.
struct TimedLine {
    explicit TimedLine(bool is_terminal) : line(out, is_terminal, "cases", [this] { return at_s; }) {}
    void report(double done, double now_s) {
        at_s = now_s;
        line.report(done);
    }
    std::ostringstream out{};
    double at_s = 100.0;
    ProgressLine line;
};

TEST(Progress, SaysTheTimeLeftAndClearsALongerOne) {
    TimedLine bar(true);
    bar.report(0.0, 100.0);
    bar.report(0.5, 110.0);
    bar.report(0.501, 110.0);
    bar.report(0.508, 110.0);
    bar.report(0.55, 110.0);
    EXPECT_THAT(bar.out.str(), ::testing::HasSubstr(" 50 %, 10 s left\r"));
    EXPECT_THAT(bar.out.str(), ::testing::EndsWith(" 55 %, 9 s left "));
    TimedLine log(false);
    log.report(0.0, 0.0);
    log.report(0.1, 60.0);
    EXPECT_EQ(log.out.str(), "cases 10 %, 9 min left\n");
}

TEST(Progress, EstimatesByThePaceOfThisRunAlone) {
    TimedLine log(false);
    log.report(0.5, 0.0);  // done by an earlier run
    log.report(0.6, 28.0);
    EXPECT_THAT(log.out.str(), ::testing::EndsWith("cases 60 %, 2 min left\n"));
}

TEST(Progress, SaysNoTimeOfShortWork) {
    TimedLine log(false);
    log.report(0.1, 0.0);
    log.report(0.5, 1.0);
    log.report(1.0, 5.0);
    EXPECT_EQ(log.out.str(), "cases 10 %\ncases 50 %\ncases 100 %\n");
}

TEST(Progress, SaysDurationsAsPeopleDo) {
    EXPECT_EQ(time_left(0.0), "");
    EXPECT_EQ(time_left(17.2), "18 s left");
    EXPECT_EQ(time_left(540.0), "9 min left");
    EXPECT_EQ(time_left(5940.0), "1 h 39 min left");
}

}  // namespace
}  // namespace osteomill
