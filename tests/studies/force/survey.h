// The accuracy of the voxel model over everything it promises: a fixed set of steady motions, each against
// the analytical reference and its target.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/studies/force/steady_run.h"

namespace osteomill::study {

/// One motion and how well the model must do.
struct SurveyPoint {
    std::string group{};  ///< what varies among its neighbours: "depth", "tilt", "surface" ...
    SteadyCase motion{};
    SteadyRun run{};
    double tilt_deg = 0.0;                ///< of the spindle from the surface's normal
    double azimuth_deg = 0.0;             ///< of that tilt, from the feed
    double most_error = 0.02;             ///< share of the reference force
    std::optional<double> most_ripple{};  ///< share of the mean force; std::nullopt where none is promised
};

/// The whole set: one sweep a parameter, from a 5 mm burr (and the other sizes where it matters), and an even
/// sample of all parameters at once. `quick` keeps every group but fewer points of each. Always the same.
std::vector<SurveyPoint> survey_points(bool quick);

struct SurveyResult {
    SurveyPoint point;
    glm::dvec3 reference_n{0.0};
    glm::dvec3 force_n{0.0};
    double error = 0.0;
    double removal_error = 0.0;
    double ripple = 0.0;
    double step_us = 0.0;  ///< median

    bool meets_error() const { return error <= point.most_error; }
    bool meets_ripple() const { return !point.most_ripple || ripple <= *point.most_ripple; }
};

SurveyResult measure(const SurveyPoint& point, const MakeModel& make_model);

/// Table with a header, a line a point.
std::string csv_of(const std::vector<SurveyResult>& results);

/// For each group: points, how many miss their target of error and of ripple, median and largest of both; and
/// the points farthest over target, by name.
nlohmann::ordered_json summary_of(const std::vector<SurveyResult>& results);

}  // namespace osteomill::study
