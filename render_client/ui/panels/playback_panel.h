// The panel that plays a recording: play and pause, a slider for the time, the speed. Drawn with Dear ImGui;
// needs an ImGui frame to be open.
#pragma once

#include "render_client/link/recording_player.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

/// The panel's size: as wide as is useful in a picture of that size.
glm::vec2 playback_panel_size(const PanelPainter& painter, const glm::vec2& picture);
void draw_playback_panel(RecordingPlayer& player, const PanelPainter& painter, const PanelPlace& place);

}  // namespace osteomill
