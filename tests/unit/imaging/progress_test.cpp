#include "imaging/progress.h"

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
TEST(Progress, SaysWhatStandsBehindThePercentageAndClearsIt) {
    std::ostringstream bar;
    ProgressLine line(bar, true, "cases");
    line.report(0.501, "12 s left");
    line.report(0.502, "12 s left");
    line.report(0.503, "9 s left");
    const std::string text = bar.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
    EXPECT_THAT(text, ::testing::EndsWith(" 50 %, 9 s left "));
    std::ostringstream log;
    ProgressLine(log, false, "cases").report(0.5, "12 s left");
    EXPECT_EQ(log.str(), "cases 50 %, 12 s left\n");
}

}  // namespace
}  // namespace osteomill
