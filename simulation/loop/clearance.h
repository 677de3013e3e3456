// Check that a burr and its shank stand clear of the bone, as the milling loop last saw it.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/exchange/milling_step.h"
#include "simulation/safety/watchdog.h"

namespace osteomill {

/// Bone that reaches into the burr by less than this share of a voxel does not count: gaps are no better.
inline constexpr double clearance_voxels = 0.2;

/// Of a burr at `position_mm` (patient LPS) with its spindle off. In bone: bone around `latest` reaches into
/// it or its shank, or lies in it as a model without an engagement says. Unknown: it is farther from where
/// the milling loop had it than the engagement map sees (Engagement::reach_voxels), or there is no result
/// yet. Real-time safe.
Clearance clearance_of(const MillingResult& latest, const glm::dvec3& position_mm) noexcept;

}  // namespace osteomill
