// The overlay of the picture: panels, plots, legend, scale bar, orientation cube, warnings, help. Drawn with
// Dear ImGui; needs an ImGui frame to be open.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "render_client/ui/panels/live_plot.h"
#include "render_client/ui/panels/panel_text.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/slices_view.h"
#include "render_client/ui/view/view_settings.h"
#include "render_client/volume/camera.h"

namespace osteomill {

struct StartScreen;

/// The parts of a window that panels show and change; each panel takes only those that it needs.
struct OverlayContent {
    SeenSession session;
    PictureProgress picture;
    const ToolHistory& history;
    Camera& camera;
    ViewSettings& view;
    SlicesView* slices = nullptr;            ///< null if no slices are shown
    const gl::Framebuffer* inset = nullptr;  ///< null if no second view is shown
    const Bone* bone = nullptr;              ///< null until one has come
    std::uint64_t bone_version = 0;
    bool is_bone_drawn = false;
    /// Takes requests made with buttons; null if nobody can press them, as in offscreen pictures.
    SessionRequests* requests = nullptr;
    StartScreen* start = nullptr;       ///< null if no session is started from here
    RecordingPlayer* player = nullptr;  ///< null unless a recording is shown
};

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px);

}  // namespace osteomill
