#include "studies/stability/map/stability_study.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/output/study_run.h"
#include "studies/stability/map/map_summary.h"
#include "studies/stability/map/map_table.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/method_score.h"
#include "studies/stability/map/region_table.h"
#include "studies/stability/map/whole_map.h"
#include "studies/stability/rails/motion_on_rails.h"
#include "studies/stability/scene/map_run.h"
#include "studies/stability/sites/site_study.h"

namespace osteomill::study {

namespace {

struct StabilityCommand {
    std::filesystem::path out = "study/stability";
    MapSelection selection{};
    // In place of the map.
    bool runs_sites = false;
    int motions_on_rails = 0;
    SiteStudyOptions sites{};  ///< without what the map's options say
};

std::vector<std::string> grip_names() {
    std::vector<std::string> names;
    for (const MapGrip grip : map_grips()) names.push_back(name_of(grip));
    return names;
}

void set_grips(std::vector<MapGrip>& grips, const std::vector<std::string>& names) {
    for (const std::string& name : names) grips.push_back(grip_named(name));
}

/// What is run in the map's place. Couplings, --out and --quick are the map's.
void add_sites(CLI::App& stability, StabilityCommand& command) {
    CLI::Option* const sites = stability.add_flag(
        "--sites", command.runs_sites,
        "instead of the map: sites where bone ends, such as plates, edges, holes and tunnels");
    for (const char* of_the_map : {"--grips", "--milling-rates-hz", "--delays"})
        sites->excludes(stability.get_option(of_the_map));
    stability.add_option("--walks", command.sites.walks, "so many random walks of a hand, too")
        ->needs(sites)
        ->check(CLI::Range(0, 100'000));
    stability
        .add_option(
            "--rails", command.motions_on_rails,
            "instead of the map: so many random steady motions of a hand on rails, and how far the mean "
            "force on it is from the milling model's")
        ->excludes(sites)
        ->check(CLI::Range(1, 100'000));
    stability.add_option("--seed", command.sites.seed, "of the random walks or motions")
        ->capture_default_str();
    stability
        .add_option("--only", command.sites.only,
                    "only sites whose name holds this text; of one alone OUT/trace.csv has every tick")
        ->needs(sites);
}

void write_results(const WholeMap& map, const StudyRun& run) {
    run.write(map_table_of(map), "map");
    run.write(summary_of(map), "map");
    run.write(region_table_of(map, MapScene::cutting), "regions_cutting");
    run.write(region_table_of(map, MapScene::wall), "regions_wall");
    run.write(region_rows_of(map), "region_rows");
    run.write(pareto_table_of(method_scores(map, MapPart::map, MapScene::cutting)), "pareto_cutting");
    run.write(pareto_table_of(method_scores(map, MapPart::map, MapScene::wall)), "pareto_wall");
    run.write(error_table_of(map), "errors");
    run.draw({"map_cutting"});
    // With edges that rub there is no wall, which the others compare with.
    if (!map.selection.has_edge_forces) run.draw({"map_wall", "map_pareto", "map_errors"});
    run.say("{}map.json, tables (CSV) and charts (SVG) are in {}", summary_text_of(map), run.out().string());
}

void run_map(const MapSelection& selection, const std::filesystem::path& out,
             const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    WholeMap map{.selection = selection, .points = map_points(selection), .outcomes = {}};
    if (map.points.empty()) throw std::runtime_error("nothing of the map is selected");
    SceneCache cache;
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        map.points, [](const MapPoint& point) { return text_of(point); },
        [&](const MapPoint& point) { return run_map_case(point.run, cache); });
    if (!run.perform()) return;
    map.outcomes = planned.outcomes();
    write_results(map, run);
}

void perform(const StabilityCommand& command, const StudySurroundings& surroundings) {
    const std::vector<std::string>& methods = command.selection.methods;
    const std::filesystem::path& out = command.out;
    if (command.motions_on_rails > 0)
        return run_rails_study({.count = command.motions_on_rails,
                                .seed = command.sites.seed,
                                .methods = methods.empty() ? std::vector<std::string>{"implicit"} : methods,
                                .has_edge_forces = command.selection.has_edge_forces},
                               out, surroundings);
    if (command.runs_sites) {
        SiteStudyOptions sites = command.sites;
        sites.has_edge_forces = command.selection.has_edge_forces;
        sites.out = out;
        sites.quick = command.selection.quick;
        if (!methods.empty()) sites.methods = methods;
        return run_site_study(sites, surroundings);
    }
    run_map(command.selection, out, surroundings);
}

}  // namespace

StudyCommand add_stability(CLI::App& app) {
    const auto shared = std::make_shared<StabilityCommand>();
    StabilityCommand& command = *shared;
    MapSelection& selection = command.selection;
    CLI::App* const stability = app.add_subcommand(
        "stability", "the stability map: which coupling holds where, and how true it is there");
    add_out(*stability, command.out);
    stability->add_flag("--quick", selection.quick, "a coarser map: a minute on two cores");
    stability
        ->add_option("--methods", selection.methods, "only these couplings of the map, with commas between")
        ->delimiter(',')
        ->check(CLI::IsMember(map_methods()));
    stability
        ->add_option_function<std::vector<std::string>>(
            "--grips",
            [&selection](const std::vector<std::string>& names) { set_grips(selection.grips, names); },
            "only these grips")
        ->delimiter(',')
        ->check(CLI::IsMember(grip_names()));
    stability
        ->add_option("--milling-rates-hz", selection.milling_rates_hz, "only these rates of the milling loop")
        ->delimiter(',')
        ->check(CLI::IsMember(map_milling_rates_hz()));
    stability->add_option("--delays", selection.delays_ticks, "only these delays, in haptic ticks")
        ->delimiter(',')
        ->check(CLI::IsMember(map_delays_ticks()));
    stability->add_flag("--edge-forces", selection.has_edge_forces,
                        "of the map: cutting alone, by burrs whose edges rub; of sites: the same burrs, "
                        "and what holds a hand that presses and does not cut counts as stuck");
    add_sites(*stability, command);
    return {stability, [shared](const StudySurroundings& surroundings) { perform(*shared, surroundings); },
            jobs_of_processors()};
}

}  // namespace osteomill::study
