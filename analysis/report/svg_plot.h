// A plot as SVG to stand in an HTML page: one or more lines over a common axis, and moments that are marked.
#pragma once

#include <string>
#include <vector>

namespace osteomill {

struct PlotLine {
    std::string name{};  ///< in the legend, if there are several
    std::vector<double> x{};
    std::vector<double> y{};
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
    bool y_from_zero = true;
};

/// Values that are not finite are left out. Only points that can be seen are written: the least and the
/// greatest of each column of pixels.
std::string to_svg(const SvgPlot& plot);

}  // namespace osteomill
