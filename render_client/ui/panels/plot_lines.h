// The arithmetic of a plot of the last seconds: its scale, and the points of a line through many samples.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace osteomill {

/// Values at the lower and upper edge; round numbers or zero.
struct PlotRange {
    double low = 0.0;
    double high = 1.0;
};

/// A range that holds `least` to `most`, and zero, and spans at least `smallest_span` (above zero).
PlotRange plot_range(double least, double most, double smallest_span);

struct PlotSample {
    double age_s = 0.0;  ///< before the newest
    double value = 0.0;
};

/// Points of a line through `samples`, oldest first, in a plot of `size` pixels whose right edge is now and
/// left edge `span_s` ago; x to the right, y down, from the plot's upper left corner. In each column of
/// pixels only the least and the greatest sample are kept, in their order: no peak is lost. Samples older
/// than `span_s` are left out, values beyond the range lie on its edge.
std::vector<glm::vec2> plot_points(std::span<const PlotSample> samples, double span_s, const PlotRange& range,
                                   const glm::vec2& size);

}  // namespace osteomill
