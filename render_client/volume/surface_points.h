// Points of the bone's surface: under a click, and before a burr.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "common/bone/bone.h"
#include "common/session/tool_state.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

/// Point of the bone's surface under a click.
struct SurfacePoint {
    glm::dvec3 position_mm{0.0};       ///< patient LPS
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, out of the bone, of what is within a millimetre or so
};

/// Place where the ray through a pixel first meets bone that no cut hides; nothing if it meets none.
std::optional<SurfacePoint> pick_surface(const Bone& bone, const Camera& camera, const glm::dvec2& pixel,
                                         const glm::ivec2& size_px, std::span<const CutPlane> cuts);

// The bone before a burr: its distance along the spindle, and the visibility of a place on it.

/// Limit of the search ahead.
inline constexpr double farthest_ahead_mm = 20.0;

/// From the burr's surface to the bone that its centre would meet along the spindle; 0 if they touch. Nothing
/// if there is no bone within farthest_ahead_mm of the centre.
std::optional<double> bone_ahead_mm(const Bone& bone, const ToolState& tool, double burr_radius_mm);

/// Whether bone that no cut hides lies between an eye and a place on the surface of bone.
bool is_behind_bone(const Bone& bone, const glm::dvec3& eye_mm, const glm::dvec3& place_mm,
                    std::span<const CutPlane> cuts = {});

/// Whether one of the cuts hides what is there.
bool is_cut_away(const glm::dvec3& place_mm, std::span<const CutPlane> cuts);

}  // namespace osteomill
