// Point of the bone's surface under a click.
#pragma once

#include <optional>
#include <span>

#include "common/bone/bone.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

struct SurfacePoint {
    glm::dvec3 position_mm{0.0};       ///< patient LPS
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, out of the bone, of what is within a millimetre or so
};

/// Place where the ray through a pixel first meets bone that no cut hides; nothing if it meets none.
std::optional<SurfacePoint> pick_surface(const Bone& bone, const Camera& camera, const glm::dvec2& pixel,
                                         const glm::ivec2& size_px, std::span<const CutPlane> cuts);

}  // namespace osteomill
