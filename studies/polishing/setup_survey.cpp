#include "studies/polishing/setup_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "studies/polishing/force_measures.h"
#include "studies/polishing/polishing_run.h"

namespace osteomill::study {

namespace {

SurveyedSetup survey(const Specimen& cube, const PolishingSetup& setup, const std::filesystem::path& log) {
    const PolishingRun run = run_by_hand(cube, setup, log);
    SurveyedSetup found{.setup = setup,
                        .reached_end = run.reached_end,
                        .slide_s = run.slide_s,
                        .depth_mm = run.depth_mm,
                        .stray_mm = run.stray_mm,
                        .mean_force_n = mean_force_n(run.record)};
    for (const RecordedForce& sample : run.record)
        found.peak_force_n = std::max(found.peak_force_n, glm::length(sample.force_n));
    return found;
}

}  // namespace

std::vector<SurveyedSetup> survey_setups(const Specimen& cube, bool quick,
                                         const std::filesystem::path& folder, const Progress& progress) {
    const std::vector<double> strokes_mm = quick ? std::vector{8.0} : std::vector{2.0, 5.0, 8.0, 20.0, 40.0};
    const std::vector<double> speeds_rpm =
        quick ? std::vector{40'000.0, 80'000.0} : std::vector{10'000.0, 20'000.0, 40'000.0, 80'000.0};
    std::vector<SurveyedSetup> surveyed;
    const auto count = static_cast<double>(strokes_mm.size() * speeds_rpm.size());
    for (const double stroke_mm : strokes_mm) {
        for (const double rpm : speeds_rpm) {
            const std::string log = fmt::format("setup_{:.0f}rpm_{:.0f}mm.csv", rpm, stroke_mm);
            surveyed.push_back(survey(cube, {.spindle_rpm = rpm, .stroke_mm = stroke_mm}, folder / log));
            progress(static_cast<double>(surveyed.size()) / count);
        }
    }
    return surveyed;
}

std::string csv_of(const std::vector<SurveyedSetup>& surveyed) {
    std::string csv = "rpm,stroke_mm,reached_end,slide_s,depth_mm,stray_mm,mean_force_n,peak_force_n\n";
    for (const SurveyedSetup& s : surveyed)
        csv += fmt::format("{:.0f},{:.0f},{:d},{:.2f},{:.3f},{:.3f},{:.4f},{:.4f}\n", s.setup.spindle_rpm,
                           s.setup.stroke_mm, s.reached_end ? 1 : 0, s.slide_s, s.depth_mm, s.stray_mm,
                           s.mean_force_n, s.peak_force_n);
    return csv;
}

}  // namespace osteomill::study
