#include "studies/stability/map/stability_options.h"

#include <algorithm>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "common/program/progress.h"
#include "studies/stability/encoder/encoder_noise.h"
#include "studies/stability/encoder/spring_choice.h"
#include "studies/stability/encoder/tissue_forces.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/stability_study.h"
#include "studies/stability/rails/force_response.h"
#include "studies/stability/rails/motion_on_rails.h"
#include "studies/stability/scene/map_run.h"
#include "studies/stability/sites/site_study.h"

namespace osteomill::study {

namespace {

struct StabilityCommand {
    StabilityStudyOptions run{};
    std::vector<std::filesystem::path> merge{};  ///< empty: run; else join these
    // In place of the map.
    bool runs_sites = false;
    int motions_on_rails = 0;
    bool varies_encoders = false;
    bool varies_springs = false;
    bool varies_tissues = false;
    bool varies_frequency = false;
    SiteStudyOptions sites{};  ///< without what the map's options say
};

std::vector<std::string> grip_names() {
    std::vector<std::string> names;
    for (const MapGrip grip : map_grips()) names.push_back(name_of(grip));
    return names;
}

void set_shard(Shard& shard, const std::string& text) {
    try {
        shard = shard_named(text);
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError("--shard", error.what());
    }
}

void set_grips(std::vector<MapGrip>& grips, const std::vector<std::string>& names) {
    for (const std::string& name : names) grips.push_back(grip_named(name));
}

/// What is run in the map's place. Couplings, --out, --quick and --jobs are the map's.
void add_sites(CLI::App& stability, StabilityCommand& command, CLI::Option* merge) {
    CLI::Option* const sites =
        stability
            .add_flag("--sites", command.runs_sites,
                      "instead of the map: sites where bone ends, such as plates, edges, holes and tunnels")
            ->excludes(merge);
    for (const char* of_the_map : {"--shard", "--grips", "--milling-rates-hz", "--delays"})
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
        ->excludes(merge)
        ->check(CLI::Range(1, 100'000));
    CLI::Option* const encoders =
        stability
            .add_flag("--encoders", command.varies_encoders,
                      "instead of the map: the tooth scene with arms of finer and coarser encoders")
            ->excludes(sites)
            ->excludes(merge);
    stability
        .add_flag("--response", command.varies_frequency,
                  "instead of the map: how the force on the hand follows the feed, from 0.3 to 30 Hz")
        ->excludes(sites)
        ->excludes(merge)
        ->excludes(encoders);
    stability
        .add_flag("--springs", command.varies_springs,
                  "instead of the map: what a stiffer spring brings and costs each shipped arm")
        ->excludes(sites)
        ->excludes(merge)
        ->excludes(encoders);
    stability
        .add_flag("--tissues", command.varies_tissues,
                  "instead of the map: what a hand feels of each tissue of the tooth with each shipped arm")
        ->excludes(sites)
        ->excludes(merge)
        ->excludes(encoders);
    stability.add_option("--seed", command.sites.seed, "of the random walks or motions")
        ->capture_default_str();
    stability
        .add_option("--only", command.sites.only,
                    "only sites whose name holds this text; of one alone OUT/trace.csv has every tick")
        ->needs(sites);
}

void run_on_rails(const StabilityCommand& command, const StudySurroundings& surroundings) {
    std::vector<std::string> methods = command.run.selection.methods;
    if (methods.empty()) methods = {"implicit"};
    nlohmann::ordered_json summary;
    for (const std::string& method : methods) {
        ProgressLine line(surroundings.progress, surroundings.is_terminal, method);
        std::vector<RailsResult> results;
        auto motions = motions_on_rails(command.motions_on_rails, command.sites.seed);
        if (command.run.selection.has_edge_forces)
            for (SteadyCase& motion : motions) motion.burr.edge_coefficients_n_per_mm = {0.3, 0.3, 0.0};
        for (const SteadyCase& motion : motions) {
            results.push_back({motion.name, run_on_rails(motion, method)});
            line.report(static_cast<double>(results.size()) / static_cast<double>(motions.size()));
        }
        summary[method] = summary_of(results);
    }
    write_json(summary, command.run.out / "rails.json");
    surroundings.said << summary.dump(2) << '\n';
}

void perform(const StabilityCommand& command, const StudySurroundings& surroundings) {
    if (command.motions_on_rails == 0) require_charts();
    make_folder(command.run.out);
    if (command.motions_on_rails > 0) return run_on_rails(command, surroundings);
    if (command.varies_encoders) {
        const auto& methods = command.run.selection.methods;
        return run_encoder_study(methods.empty() ? "implicit" : methods.front(), command.run.out,
                                 surroundings);
    }
    if (command.varies_springs) return run_spring_study(command.run.out, surroundings);
    if (command.varies_tissues) return run_tissue_study(command.run.out, surroundings);
    if (command.varies_frequency) return run_response_study(command.run.out, surroundings);
    if (command.runs_sites) {
        SiteStudyOptions sites = command.sites;
        sites.has_edge_forces = command.run.selection.has_edge_forces;
        sites.out = command.run.out;
        sites.quick = command.run.selection.quick;
        sites.jobs = command.run.jobs;
        if (!command.run.selection.methods.empty()) sites.methods = command.run.selection.methods;
        run_site_study(sites, surroundings);
        return;
    }
    if (!command.merge.empty()) {
        merge_stability_study(command.merge, command.run.out, surroundings);
        return;
    }
    SceneCache cache;
    run_stability_study(
        command.run, [&](const MapCase& c) { return run_map_case(c, cache); }, surroundings);
}

}  // namespace

StudyCommand add_stability(CLI::App& app) {
    const auto shared = std::make_shared<StabilityCommand>();
    StabilityCommand& command = *shared;
    StabilityStudyOptions& run = command.run;
    MapSelection& selection = run.selection;
    run.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    CLI::App* const stability = app.add_subcommand(
        "stability", "the stability map: which coupling holds where, and how true it is there");
    stability
        ->add_option("--out", run.out,
                     "folder for what the study writes; made if it is not there. Cases that an earlier run "
                     "left there are not run again")
        ->capture_default_str();
    CLI::Option* const merge = stability->add_option(
        "--merge", command.merge,
        "join parts that ran apart, files of cases or folders that hold them, and write the results");
    merge->expected(1, -1);
    // What is run is known from the parts when they are joined.
    const auto of_a_run = [&](CLI::Option* option) { return option->excludes(merge); };
    of_a_run(stability->add_flag("--quick", selection.quick, "a coarser map: a minute on two cores"));
    of_a_run(stability->add_option("--jobs", run.jobs, "cases that run at a time"))
        ->capture_default_str()
        ->check(CLI::Range(1, 1024));
    of_a_run(stability->add_option_function<std::string>(
        "--shard", [&run](const std::string& text) { set_shard(run.shard, text); },
        "run part I of N only: I/N"));
    of_a_run(stability->add_option("--methods", selection.methods,
                                   "only these couplings of the map, with commas between"))
        ->delimiter(',')
        ->check(CLI::IsMember(map_methods()));
    of_a_run(stability->add_option_function<std::vector<std::string>>(
                 "--grips",
                 [&selection](const std::vector<std::string>& names) { set_grips(selection.grips, names); },
                 "only these grips"))
        ->delimiter(',')
        ->check(CLI::IsMember(grip_names()));
    of_a_run(stability->add_option("--milling-rates-hz", selection.milling_rates_hz,
                                   "only these rates of the milling loop"))
        ->delimiter(',')
        ->check(CLI::IsMember(map_milling_rates_hz()));
    of_a_run(stability->add_option("--delays", selection.delays_ticks, "only these delays, in haptic ticks"))
        ->delimiter(',')
        ->check(CLI::IsMember(map_delays_ticks()));
    of_a_run(
        stability->add_flag("--edge-forces", selection.has_edge_forces,
                            "of the map: cutting alone, by burrs whose edges rub; of sites: the same burrs, "
                            "and what holds a hand that presses and does not cut counts as stuck"));
    add_sites(*stability, command, merge);
    return {stability, [shared](const StudySurroundings& surroundings) { perform(*shared, surroundings); }};
}

}  // namespace osteomill::study
