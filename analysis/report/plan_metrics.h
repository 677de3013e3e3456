// Metrics of a plan: bone removed against bone planned.
//
// The planned region is the bone that at the start was of the plan's tissue, or had its voxel's centre in the
// plan's sphere or cylinder; the cavity is the bone of which more than half a voxel went. The boundary of
// each consists of its voxels that share a face with bone outside of it, so a voxel that borders only on air
// bounds neither. Surface distances lead from each boundary's voxels to the nearest of the other's; both
// directions are pooled (Heimann et al., IEEE Transactions on Medical Imaging 28 (2009); Taha and Hanbury,
// BMC Medical Imaging 15:29 (2015)).
#pragma once

#include <optional>
#include <string>

#include "analysis/report/session_trace.h"

namespace osteomill {

struct SurfaceDistance {
    double mean_mm = 0.0;
    double p95_mm = 0.0;
    double hausdorff_mm = 0.0;  ///< the largest
};

struct PlanMetrics {
    double planned_mm3 = 0.0;
    double removed_mm3 = 0.0;    ///< of the region
    double removed_share = 0.0;  ///< 0 to 1
    double outside_mm3 = 0.0;    ///< removed outside the region
    double excess_mm3 = 0.0;     ///< of these, further from it than the margin
    double margin_mm = 0.0;
    std::optional<SurfaceDistance> surface{};  ///< nothing if there is no cavity or no region
};

/// Nothing if the session has no plan.
std::optional<PlanMetrics> plan_metrics(const SessionTrace& trace);

/// "carious lesion", "sphere of 4 mm radius", ...
std::string describe(const Plan& plan);

}  // namespace osteomill
