// Marks that belong to the picture: a scale bar, and the force in newtons at the head of its arrow.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

/// A bar of a round length that is right at the depth of the camera's target.
struct ScaleBar {
    double length_mm = 0.0;
    double length_px = 0.0;
    std::string label;  ///< "5 mm", "200 um"
};

/// The longest of 1, 2 and 5 times a power of ten that spans at most `longest_px` if a pixel spans
/// `mm_per_px`, both above zero.
ScaleBar scale_bar(double mm_per_px, double longest_px);

/// Right at the depth of the camera's target, at most a fifth of the picture wide.
ScaleBar scale_bar_of(const Camera& camera, const glm::ivec2& size_px);
glm::vec2 scale_bar_size(const PanelPainter& painter, const ScaleBar& bar);
void draw_scale_bar(const PanelPainter& painter, const ScaleBar& bar, const PanelPlace& place);

/// Beside the head of the arrow, or near it at a place that no panel covers. Nothing if there is no arrow;
/// the plot has the force as well.
void draw_force_label(const PanelPainter& painter, const ToolState& tool, double burr_radius_mm,
                      const Camera& camera, const glm::ivec2& size_px,
                      std::span<const std::optional<PanelPlace>> panels);

/// Corners of a circle round the place on the bone that the burr's centre would meet along its spindle,
/// patient LPS; nothing for those that the burr hides, or a cut.
inline constexpr std::size_t touch_ring_corners = 32;
using TouchRing = std::array<std::optional<glm::dvec3>, touch_ring_corners>;

/// As large as the burr; nothing if the bone is more than 20 mm away or touches the burr, and where a cut or
/// other bone hides the place.
std::optional<TouchRing> touch_ring(const Bone& bone, const ToolState& tool, double burr_radius_mm,
                                    const glm::dvec3& eye_mm, std::span<const CutPlane> cuts);
void draw_touch_ring(const PanelPainter& painter, const TouchRing& ring, const Camera& camera,
                     const glm::ivec2& size_px);

/// Marks the whole picture as not current.
void draw_veil(const PanelPainter& painter, const glm::ivec2& size_px);

/// Round the picture, in the colour of warnings.
void draw_alarm_frame(const PanelPainter& painter, const glm::ivec2& size_px);

}  // namespace osteomill
