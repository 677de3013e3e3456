// Views of a report's pictures: at the place of work, through the target, through the nearest approach to a
// protected structure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/report/planned_region.h"
#include "analysis/report/session_trace.h"
#include "imaging/picture/bone_view.h"

namespace osteomill {

struct NamedView {
    std::string title;
    BoneView view;
};

/// From the handpiece, and two sections, of all that was planned and removed, or of all bone if there is
/// neither. Empty if there is no bone. `region`: of the session's plan, null without one.
std::vector<NamedView> views_of_work(const SessionTrace& trace, const PlannedRegion* region);

/// The burr's nearest approach to a protected structure.
struct NearestApproach {
    std::string structure;
    const TraceSample* sample = nullptr;  ///< of the trace, when it was there
    double distance_mm = 0.0;             ///< between burr's head and structure; 0: they touched
    glm::dvec3 structure_mm{0.0};         ///< the structure's voxel that is nearest to the burr's centre
};

/// Nothing if the burr was never within watched_mm() of any.
std::optional<NearestApproach> nearest_approach(const SessionTrace& trace);

/// The anatomical section through the middle of the plan, or of the work if there is none, whose plane comes
/// nearest to holding the handpiece.
std::optional<NamedView> view_of_target(const SessionTrace& trace, const PlannedRegion* region);
/// The section through burr and structure.
NamedView view_of(const NearestApproach& approach, double burr_diameter_mm);

}  // namespace osteomill
