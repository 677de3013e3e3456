// The panels over the picture: rates, connection, force with a live plot, burr, warnings, help. Drawn with
// Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render_client/ui/session_source.h"
#include "render_client/ui/tool_history.h"
#include "render_client/volume/picture_quality.h"

namespace osteomill {

struct OverlayContent {
    LinkUpdate link;
    const SessionInfo* session = nullptr;
    std::optional<ToolView> tool;
    const ToolHistory* history = nullptr;
    double render_frames_per_s = 0.0;
    PictureQuality quality;
    bool help_shown = false;
    /// What the operator asks for, where one drills from here.
    std::optional<OperatorIntent> operator_intent;
    /// Where a recording is shown: the panel that plays it takes input.
    RecordingPlayer* player = nullptr;
    /// Why there is no bone in the picture, where there is none for a reason.
    std::string bone_problem;
};

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px);

}  // namespace osteomill
