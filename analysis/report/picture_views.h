// From where the pictures of a report look: at the place of work, through the target, through the nearest
// approach to a protected structure.
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

/// From the handpiece, and two sections: all of what was planned and removed; all of the bone where there is
/// neither. Empty where there is no bone. `region`: of the session's plan, null without one.
std::vector<NamedView> views_of_work(const SessionTrace& trace, const PlannedRegion* region);

/// Where the burr came nearest to a protected structure.
struct NearestApproach {
    std::string structure;
    const TraceSample* sample = nullptr;  ///< of the trace, when it was there
    double distance_mm = 0.0;             ///< between burr's head and structure; 0: they touched
    glm::dvec3 structure_mm{0.0};         ///< the structure's voxel that is nearest to the burr's centre
};

/// Nothing where the burr was never within watched_mm() of any.
std::optional<NearestApproach> nearest_approach(const SessionTrace& trace);

/// The anatomical section through the middle of the plan, or of the work without one, that has the handpiece
/// in its plane as nearly as can be.
std::optional<NamedView> view_of_target(const SessionTrace& trace, const PlannedRegion* region);
/// The section through burr and structure.
NamedView view_of(const NearestApproach& approach, double burr_diameter_mm);

}  // namespace osteomill
