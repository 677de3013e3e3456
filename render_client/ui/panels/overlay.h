// The overlay of the picture: panels, plots, legend, scale bar, orientation cube, warnings, help. Drawn with
// Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render_client/ui/input/session_requests.h"
#include "render_client/ui/panels/tool_history.h"
#include "render_client/ui/session_source.h"
#include "render_client/ui/view/slices_view.h"
#include "render_client/ui/view/view_settings.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/picture_quality.h"

namespace osteomill {

struct StartScreen;

/// The pointers are never null but where it says so; what a panel changes, it changes through them.
struct OverlayContent {
    LinkUpdate link;
    const SessionInfo* session = nullptr;  ///< null until a server has said hello
    std::optional<ToolState> tool;
    const ToolHistory* history = nullptr;
    Camera* camera = nullptr;
    ViewSettings* view = nullptr;
    double render_frames_per_s = 0.0;
    PictureQuality quality;
    /// What the operator asks for, where one drills from here.
    std::optional<OperatorCommand> operator_command;
    /// Null where no slices are shown.
    SlicesView* slices = nullptr;
    const gl::Framebuffer* inset = nullptr;  ///< null where no second view is shown
    const Bone* bone = nullptr;              ///< null until one has come
    std::uint64_t bone_version = 0;
    /// Takes what is requested with buttons; null where there is nobody to press them, as in offscreen
    /// pictures.
    SessionRequests* requests = nullptr;
    /// Null where no session is started from here.
    StartScreen* start = nullptr;
    /// Null unless a recording is shown.
    RecordingPlayer* player = nullptr;
    /// Why there is no bone in the picture, where there is none for a reason.
    std::string bone_problem;
    /// How much of a bone or a look that is to be shown is ready; nothing where all is shown.
    std::optional<int> preparation_percent{};
    bool has_bone = false;
};

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px);

}  // namespace osteomill
