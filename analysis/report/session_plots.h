// Plots of a session against time, with its events, as SVG to stand in an HTML page.
#pragma once

#include <vector>

#include "analysis/report/session_trace.h"
#include "analysis/report/svg_plot.h"

namespace osteomill {

// Force, depth, removed volume and speed of a session against time, with its events.

std::vector<SvgPlot> session_plots(const SessionTrace& trace);

}  // namespace osteomill
