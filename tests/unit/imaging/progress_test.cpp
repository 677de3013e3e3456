#include "haptic_server/imaging/progress.h"

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

}  // namespace
}  // namespace osteomill
