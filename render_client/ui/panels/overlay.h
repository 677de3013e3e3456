// The overlay of the picture: panels, plots, legend, scale bar, orientation cube, warnings, help. Drawn with
// Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render_client/link/session_source.h"
#include "render_client/ui/input/session_requests.h"
#include "render_client/ui/panels/tool_history.h"
#include "render_client/ui/view/session_sight.h"
#include "render_client/ui/view/slices_view.h"
#include "render_client/ui/view/view_settings.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/picture_quality.h"

namespace osteomill {

struct StartScreen;

/// The pointers are never null unless stated; panels make their changes through them.
struct OverlayContent {
    LinkUpdate link;
    const SessionInfo* session = nullptr;  ///< null until a server has said hello
    std::optional<ToolState> tool;
    const ToolHistory* history = nullptr;
    Camera* camera = nullptr;
    ViewSettings* view = nullptr;
    double render_frames_per_s = 0.0;
    PictureQuality quality;
    /// The operator's command, if this client may drill.
    std::optional<OperatorCommand> operator_command;
    /// Null if no slices are shown.
    SlicesView* slices = nullptr;
    const gl::Framebuffer* inset = nullptr;  ///< null if no second view is shown
    const Bone* bone = nullptr;              ///< null until one has come
    std::uint64_t bone_version = 0;
    /// Takes requests made with buttons; null if nobody can press them, as in offscreen pictures.
    SessionRequests* requests = nullptr;
    /// Null if no session is started from here.
    StartScreen* start = nullptr;
    /// Null unless a recording is shown.
    RecordingPlayer* player = nullptr;
    /// The reason for a missing bone in the picture, if there is one.
    std::string bone_problem;
    /// Progress of the preparation of a new bone or appearance; nothing when all is shown.
    std::optional<int> preparation_percent{};
    bool has_bone = false;
    SessionSight sight = SessionSight::now;

    /// Null if there is no tool, or the server has announced no such burr.
    const Burr* burr_in_tool() const { return session && tool ? session->burr_of(tool->burr) : nullptr; }
    double burr_radius_mm() const { return burr_in_tool() != nullptr ? burr_in_tool()->radius_mm() : 0.0; }
};

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px);

}  // namespace osteomill
