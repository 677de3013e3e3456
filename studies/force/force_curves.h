// Force against depth, feed and spindle speed, beside the reference.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "common/program/progress.h"
#include "studies/force/steady_run.h"

namespace osteomill::study {

struct CurvePoint {
    double at = 0.0;  ///< mm, mm/s or 1000 rpm
    glm::dvec3 reference_n{0.0};
    glm::dvec3 voxels_n{0.0};
    glm::dvec3 bins_n{0.0};
};

/// An upright 5 mm burr, 1 mm deep at 6 mm/s and 10 000 rpm but for what varies.
struct ForceCurves {
    std::vector<CurvePoint> depth;
    std::vector<CurvePoint> feed;
    std::vector<CurvePoint> rpm;
};

ForceCurves measure_curves(bool quick, const ReportProgress& progress);

/// The first column is called `variable`.
Table table_of(const std::vector<CurvePoint>& curve, const std::string& variable);

}  // namespace osteomill::study
