// The panel that plays a recording: play and pause, a slider for the time, the speed. Drawn with Dear ImGui;
// needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>

#include "render_client/link/recording_player.h"

namespace osteomill {

void draw_playback_panel(RecordingPlayer& player, const glm::ivec2& size_px);

}  // namespace osteomill
