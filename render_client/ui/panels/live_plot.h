// The last seconds of the session in three plots under each other: force on the hand by patient axis, depth,
// removed volume; with axes, units and a legend.
#pragma once

#include <deque>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/session/tool_state.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

// The last seconds of forces, depth and removed volume, for the live plot.

/// The tool's states in the newest frames, oldest first. A frame whose time is not later than the one before
/// is left out; one that is earlier starts a new session and clears the history.
class ToolHistory {
  public:
    static constexpr double kept_s = 10.0;

    struct Sample {
        double time_s = 0.0;
        glm::dvec3 force_n{0.0};
        std::optional<double> depth_mm{};
        double removed_mm3 = 0.0;
    };

    void add(const ToolState& tool);
    const std::deque<Sample>& samples() const { return samples_; }

  private:
    std::deque<Sample> samples_;
};

/// All three plots, or the forces alone, or only the numbers.
enum class PlotDetail { all, forces, numbers };

/// `shows_solve`: adds a line below the three plots about the residual of the coupling's solve.
glm::vec2 live_plot_size(const PanelPainter& painter, PlotDetail detail, bool shows_solve);
void draw_live_plot(const PanelPainter& painter, const ToolHistory& history, const ToolState& tool,
                    PlotDetail detail, bool shows_solve, const PanelPlace& place);

// The arithmetic of a plot of the last seconds: its scale, and the points of a line through many samples.

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
