// Check that a burr and its shank stand clear of the bone, as the milling loop last saw it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/burr.h"
#include "simulation/exchange/milling_step.h"
#include "simulation/safety/watchdog.h"

namespace osteomill {

/// Bone that reaches into the burr by less than this share of a voxel does not count: gaps are no better.
inline constexpr double clearance_voxels = 0.2;

/// The clearance of a burr at `position_mm` (patient LPS) with its spindle off. In bone: bone around `latest`
/// reaches into the burr or its shank, or a model without an engagement reports bone in it. Unknown: the burr
/// is farther from its place in the milling loop than the engagement map reaches (Engagement::reach_voxels),
/// or there is no result yet. Real-time safe.
Clearance clearance_of(const MillingResult& latest, const glm::dvec3& position_mm) noexcept;

/// Balls about the spindle that together hold a burr's head and its shank: if no bone lies in them, the
/// burr may stand.
struct HullBall {
    double height_mm = 0.0;  ///< above the burr's centre, along the spindle
    double radius_mm = 0.0;
};

/// The ball itself for a ball without a shank. For anything else, the balls protrude by up to an eighth of
/// its width. Allocates.
std::vector<HullBall> burr_hull(const Burr& burr);

}  // namespace osteomill
