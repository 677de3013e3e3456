#include "analysis/report/svg_plot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(SvgPlotTest, LeavesOutWhatIsNoNumber) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const std::string svg =
        to_svg({.title = "force", .lines = {{.x = {0, 1, 2, nan}, .y = {nan, infinity, 1, 2}}}});
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_THAT(to_svg({}), HasSubstr("</svg>"));
    EXPECT_THAT(to_svg({.lines = {{.x = {5}, .y = {-3}}}}), HasSubstr("<circle"));
    EXPECT_THAT(to_svg({.lines = {{.x = {0, 1}, .y = {1e300, -1e300}}}}), Not(HasSubstr("nan")));
}

TEST(SvgPlotTest, KeepsThePeaksOfManyPoints) {
    PlotLine line;
    for (int i = 0; i < 100'000; ++i) {
        line.x.push_back(i);
        line.y.push_back(i == 43'210 ? 9.0 : 1.0);
    }
    const std::string svg = to_svg({.lines = {line}});
    EXPECT_LT(svg.size(), 40'000u);
    // From 0 to 4 per cent above the peak, over 140 units of height: the peak is 5.4 below the top at 30.
    EXPECT_THAT(svg, HasSubstr(",35.4 "));
}

TEST(SvgPlotTest, KeepsTheNamesOfManyLinesInThePicture) {
    SvgPlot plot{.title = "peak force"};
    for (int i = 0; i < 3; ++i)
        plot.lines.push_back({.name = "trainee " + std::to_string(i), .x = {1, 2}, .y = {1, 2}});
    EXPECT_THAT(to_svg(plot), HasSubstr("viewBox='0 0 900 210'"));
    for (int i = 3; i < 12; ++i)
        plot.lines.push_back({.name = "trainee " + std::to_string(i), .x = {1, 2}, .y = {1, 2}});
    // 94 or 101 units a name, and 824 available: two rows of 18.
    const std::string svg = to_svg(plot);
    EXPECT_THAT(svg, HasSubstr("viewBox='0 0 900 246'"));
    EXPECT_THAT(svg, HasSubstr("y='242.0'>trainee 11"));
    // The eighth has the first one's colour, and dashes.
    EXPECT_THAT(svg, HasSubstr("stroke='#0072b2' stroke-width='3' stroke-dasharray"));
}

TEST(SvgPlotTest, ShowsNamesAsText) {
    const std::string svg = to_svg({.title = "<i>",
                                    .lines = {{.name = "</svg>", .x = {0, 1}, .y = {0, 1}}, {}},
                                    .moments = {{0.5, "<script>"}}});
    EXPECT_THAT(svg, Not(HasSubstr("<script>")));
    EXPECT_THAT(svg, Not(HasSubstr("<i>")));
    EXPECT_EQ(svg.find("</svg>"), svg.size() - 6);
}

}  // namespace
}  // namespace osteomill
