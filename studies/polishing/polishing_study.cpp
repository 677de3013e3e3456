#include "studies/polishing/polishing_study.h"

#include <variant>
#include <vector>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"
#include "studies/polishing/polishing_run.h"
#include "studies/polishing/published_figures.h"

namespace osteomill::study {

void run_polishing_study(const PolishingStudyOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    StudyRun run(options.out, surroundings);
    const std::filesystem::path logs = options.out / "runs";
    make_folder(logs);
    const Specimen cube{bone_from_hu(std::get<HuSlices>(make_phantom("cube")), phantom_threshold_hu,
                                     phantom_scene("cube").stiffness),
                        options.has_edge_forces ? glm::dvec3(0.3, 0.3, 0.0) : glm::dvec3(0.0)};
    const std::vector<PolishingSetup> setups = setups_of_figures(options.quick);
    const auto planned = run.plan(
        setups, [](const PolishingSetup& setup) { return setup.name(); },
        [&](const PolishingSetup& setup) {
            return run_by_hand(cube, setup, logs / (setup.name() + ".csv"));
        });
    if (!run.perform()) return;

    const std::vector<PolishingRun> runs = planned.outcomes();
    for (std::size_t i = 0; i < runs.size(); ++i) run.write(series_of(runs[i].record), setups[i].name());
    run.write(as_meant(polishing_scene(cube.edge_coefficients_n_per_mm)), "as_meant");
    const Table figures = table_of(setups, runs);
    run.write(figures, "figures");
    run.say("{}", figures.csv());
    run.draw({"polishing_depth", "polishing_milling", "polishing_point_spring"});
    run.say("figures.csv, the runs (CSV) and charts (SVG) are in {}", run.out().string());
}

}  // namespace osteomill::study
