#include "tests/studies/force/force_study.h"

#include <fmt/format.h>

#include <ostream>

#include "haptic_server/imaging/progress.h"
#include "tests/studies/force/case_report.h"
#include "tests/studies/force/survey.h"

namespace osteomill::study {

namespace {

nlohmann::ordered_json run_survey(const ForceStudyOptions& options, const StudySurroundings& surroundings) {
    const auto points = survey_points(options.quick);
    std::vector<SurveyResult> results;
    {
        ProgressLine line(surroundings.progress, surroundings.is_terminal, "survey");
        for (const SurveyPoint& point : points) {
            results.push_back(measure(point, voxel_model()));
            line.report(static_cast<double>(results.size()) / static_cast<double>(points.size()));
        }
    }
    write_csv(results, options.out / "survey.csv");
    for (const SurveyResult& r : results)
        if (!r.meets_error() || !r.meets_ripple())
            surroundings.said << fmt::format(
                "misses: {}: error {:.2f} % (target {:.0f} %), ripple {:.2f} %{}\n", r.point.motion.name,
                100.0 * r.error, 100.0 * r.point.most_error, 100.0 * r.ripple,
                r.point.most_ripple ? " (target 2 %)" : "");
    return summary_of(results);
}

}  // namespace

void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings) {
    nlohmann::ordered_json found;
    found["survey"] = run_survey(options, surroundings);
    write_json(found, options.out / "force.json");
    surroundings.said << "force.json and survey.csv in " << options.out.string() << '\n';
}

}  // namespace osteomill::study
