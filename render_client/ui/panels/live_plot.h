// The last seconds of the session in three plots under each other: force on the hand by patient axis, depth,
// removed volume; with axes, units and a legend.
#pragma once

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/tool_history.h"

namespace osteomill {

/// All three plots, or the forces alone, or only the numbers.
enum class PlotDetail { all, forces, numbers };

/// `shows_solve`: adds a line below the three plots about the residual of the coupling's solve.
glm::vec2 live_plot_size(const PanelPainter& painter, PlotDetail detail, bool shows_solve);
void draw_live_plot(const PanelPainter& painter, const ToolHistory& history, const ToolState& tool,
                    PlotDetail detail, bool shows_solve, const PanelPlace& place);

}  // namespace osteomill
