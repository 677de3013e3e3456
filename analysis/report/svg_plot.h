// A plot as SVG to stand in an HTML page: one or more lines over a common axis, and moments that are marked.
#pragma once

#include <string>
#include <vector>

namespace osteomill {

struct PlotLine {
    std::string name{};  ///< in the legend, if there are several
    std::vector<double> x{};
    std::vector<double> y{};
    bool has_dots = false;  ///< each point is a dot on the line
    bool is_bold = false;   ///< a fit to the others, in black
};

/// An area between two curves, behind the lines.
struct PlotBand {
    std::string text{};  ///< beside its right end
    std::vector<double> x{};
    std::vector<double> low{};
    std::vector<double> high{};
    const char* colour = "#999";
};

/// A dashed line across the plot.
struct PlotLevel {
    double y = 0.0;
    std::string text{};
};

struct PlotMoment {
    double x = 0.0;
    std::string text{};
};

struct SvgPlot {
    std::string title{};
    std::string x_text{};  ///< "time (s)"
    std::string y_text{};  ///< "force (N)"
    std::vector<PlotLine> lines{};
    std::vector<PlotMoment> moments{};
    std::vector<PlotBand> bands{};
    std::vector<PlotLevel> levels{};
    bool y_from_zero = true;
    bool x_is_count = false;  ///< whole numbers, with room about the first and the last
};

/// Values that are not finite are left out. However many points there are, no more are written than can be
/// seen: for each column of pixels the least and the greatest.
std::string to_svg(const SvgPlot& plot);

}  // namespace osteomill
