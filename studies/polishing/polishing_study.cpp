#include "studies/polishing/polishing_study.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <variant>
#include <vector>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"
#include "studies/polishing/polishing_run.h"
#include "studies/polishing/published_figures.h"

namespace osteomill::study {

namespace {

struct PolishingStudyOptions {
    std::filesystem::path out = "study/polishing";
    bool quick = false;            ///< fewer runs: half a minute at most
    bool has_edge_forces = false;  ///< burrs whose edges rub with 0.3 N/mm; else the published law
};

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

}  // namespace

StudyCommand add_polishing(CLI::App& app) {
    const auto shared = std::make_shared<PolishingStudyOptions>();
    PolishingStudyOptions& options = *shared;
    CLI::App* polishing = app.add_subcommand("polishing", "the published polishing experiment: its figures");
    add_out(*polishing, options.out);
    polishing->add_flag("--edge-forces", options.has_edge_forces,
                        "burrs whose edges rub, as in cortical bone; without, the published law");
    polishing->add_flag("--quick", options.quick, "fewer runs: under half a minute");
    return {polishing,
            [shared](const StudySurroundings& surroundings) { run_polishing_study(*shared, surroundings); },
            jobs_of_processors()};
}

}  // namespace osteomill::study
