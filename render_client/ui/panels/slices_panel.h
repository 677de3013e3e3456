// The panel of three slices through the CT, linked by a cross-hair that the mouse moves. Drawn with Dear
// ImGui; needs an ImGui frame to be open.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/slices_view.h"
#include "render_client/volume/camera.h"

namespace osteomill {

/// Best first.
std::vector<glm::vec2> slices_panel_sizes(const PanelPainter& painter);
/// A bone whose border they show: null until one has come; `version` changes with it.
struct SlicedBone {
    const Bone* bone = nullptr;
    std::uint64_t version = 0;
};
/// `requests`: null if nobody can press buttons.
void draw_slices_panel(SlicesView& slices, const SeenSession& session, const SlicedBone& bone,
                       const PanelPlace& place, SessionRequests* requests);

/// Marks, in the picture of the bone, the place where the slices cross.
void draw_slices_cross(const SlicesView& slices, const Camera& camera, const PanelPainter& painter,
                       const glm::ivec2& size_px);

}  // namespace osteomill
