// Force against depth, feed and spindle speed, beside the reference.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/cases/json_values.h"
#include "analysis/output/table.h"
#include "studies/force/steady_run.h"

namespace osteomill::study {

struct CurvePoint {
    double at = 0.0;  ///< mm, mm/s or 1000 rpm
    glm::dvec3 reference_n{0.0};
    glm::dvec3 voxels_n{0.0};
    glm::dvec3 bins_n{0.0};
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CurvePoint, at, reference_n, voxels_n, bins_n)

/// A point to measure: a motion, named by what varies.
struct CurveCase {
    double at = 0.0;
    SteadyCase motion;
};

/// An upright 5 mm burr, 1 mm deep at 6 mm/s and 10 000 rpm but for what varies.
std::vector<CurveCase> depth_curve();
std::vector<CurveCase> feed_curve();
std::vector<CurveCase> rpm_curve();

CurvePoint measure(const CurveCase& c, bool quick);

/// The first column is called `variable`.
Table table_of(const std::vector<CurvePoint>& curve, const std::string& variable);

}  // namespace osteomill::study
