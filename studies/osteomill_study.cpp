// osteomill_study: what the simulator's choices cost and what they are worth. Parses, runs a study, says
// where its files are.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "analysis/calibration/calibration_options.h"
#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "analysis/sessions/sessions_options.h"
#include "common/program/option_checks.h"
#include "common/text/plain_text.h"
#include "imaging/progress.h"
#include "studies/bridge/bridge_options.h"
#include "studies/force/case_report.h"
#include "studies/force/force_study.h"
#include "studies/loads/loads_study.h"
#include "studies/polishing/polishing_options.h"
#include "studies/realtime/realtime_options.h"
#include "studies/render/render_options.h"
#include "studies/stability/encoder/encoder_noise.h"
#include "studies/stability/encoder/spring_choice.h"
#include "studies/stability/map/stability_options.h"
#include "studies/stability/rails/force_response.h"
#include "studies/stability/rails/motion_on_rails.h"
#include "studies/stability/scene/map_run.h"

namespace {

constexpr int exit_failure = 1;
constexpr int exit_usage = 2;

struct ForceOptions {
    std::filesystem::path out = "study/force";
    std::filesystem::path cases{};
    osteomill::study::SteadyRun run{};
    std::optional<int> random{};
    std::uint64_t seed = 1;
    std::optional<double> depth_mm{};
    bool has_edge_forces = false;
    bool has_heads = false;
    bool loads = false;
    bool quick = false;
};

void add_force(CLI::App& app, ForceOptions& options) {
    CLI::App* force =
        app.add_subcommand("force", "the milling force: voxel model against analytical reference");
    force->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    CLI::Option* cases = force->add_option(
        "--cases", options.cases,
        "run the steady motions of this JSON file (the schema of tests/data/milling_forces.json) and "
        "write OUT/cases.json; nothing else is run");
    CLI::Option* random =
        force
            ->add_option(
                "--random", options.random,
                "run so many steady motions drawn at random and write OUT/random.json and random.csv; "
                "nothing else is run")
            ->excludes(cases)
            ->check(CLI::Range(1, 1'000'000));
    force->add_option("--seed", options.seed, "of the random motions")->needs(random)->capture_default_str();
    force->add_option("--depth-mm", options.depth_mm, "of all random motions, in the place of their own")
        ->needs(random)
        ->check(osteomill::within(0.001, 5.0));
    force->add_flag("--edge-forces", options.has_edge_forces, "burrs whose edges rub, by random coefficients")
        ->needs(random);
    force
        ->add_flag("--heads", options.has_heads,
                   "cylinders, cones, barrels and pears in the place of balls, of random proportions")
        ->needs(random);
    force
        ->add_flag(
            "--loads", options.loads,
            "what a burr removes that is pressed on each material; writes OUT/loads.csv; nothing else is run")
        ->excludes(cases)
        ->excludes(random);
    force->add_flag("--quick", options.quick, "fewer points, shorter runs: under a minute")
        ->excludes(cases)
        ->excludes(random);
    force->add_option("--voxel-mm", options.run.voxel_mm, "edge of a voxel, of --cases and --random")
        ->capture_default_str()
        ->check(osteomill::within(0.01, 1.0));
    force->add_option("--milling-rate-hz", options.run.milling_rate_hz, "steps of the voxel model a second")
        ->needs(cases)
        ->capture_default_str()
        ->check(osteomill::within(1.0, 100'000.0));
    force
        ->add_option("--travel-mm", options.run.travel_mm,
                     "way over which force is averaged, for motions along the surface (20 steps at least)")
        ->needs(cases)
        ->capture_default_str()
        ->check(osteomill::within(0.01, 100.0));
}

osteomill::study::StudySurroundings surroundings() {
    return {.said = std::cout, .progress = std::cerr, .is_terminal = ::isatty(STDERR_FILENO) != 0};
}

void run_cases(const ForceOptions& options) {
    using namespace osteomill;
    const auto cases = study::read_steady_cases(options.cases);
    const std::filesystem::path file = options.out / "cases.json";
    {
        ProgressLine line(std::cerr, ::isatty(STDERR_FILENO) != 0, "cases");
        study::write_json(study::report_of(cases, options.run, study::voxel_model(), line.reporter()), file);
    }
    std::cout << cases.size() << " cases in " << file.string() << '\n';
}

void run(const ForceOptions& options) {
    const bool has_charts = !options.loads && options.cases.empty() && !options.random;
    if (has_charts) osteomill::study::require_charts();
    osteomill::study::make_folder(options.out);
    if (options.loads)
        osteomill::study::run_loads_study(options.out, surroundings());
    else if (!options.cases.empty())
        run_cases(options);
    else if (options.random)
        osteomill::study::run_random_motions({.out = options.out,
                                              .count = *options.random,
                                              .seed = options.seed,
                                              .voxel_mm = options.run.voxel_mm,
                                              .depth_mm = options.depth_mm,
                                              .has_edge_forces = options.has_edge_forces,
                                              .has_heads = options.has_heads},
                                             surroundings());
    else
        osteomill::study::run_force_study({.out = options.out, .quick = options.quick}, surroundings());
}

void run_on_rails(const osteomill::study::StabilityCommand& command) {
    using namespace osteomill;
    std::vector<std::string> methods = command.run.selection.methods;
    if (methods.empty()) methods = {"implicit"};
    nlohmann::ordered_json summary;
    for (const std::string& method : methods) {
        ProgressLine line(std::cerr, ::isatty(STDERR_FILENO) != 0, method);
        std::vector<study::RailsResult> results;
        auto motions = study::motions_on_rails(command.motions_on_rails, command.sites.seed);
        if (command.run.selection.has_edge_forces)
            for (study::SteadyCase& motion : motions)
                motion.burr.edge_coefficients_n_per_mm = {0.3, 0.3, 0.0};
        for (const study::SteadyCase& motion : motions) {
            results.push_back({motion.name, study::run_on_rails(motion, method)});
            line.report(static_cast<double>(results.size()) / static_cast<double>(motions.size()), "");
        }
        summary[method] = study::summary_of(results);
    }
    study::write_json(summary, command.run.out / "rails.json");
    std::cout << summary.dump(2) << '\n';
}

void run(const osteomill::study::StabilityCommand& command) {
    using namespace osteomill;
    if (command.motions_on_rails == 0) study::require_charts();
    study::make_folder(command.run.out);
    if (command.motions_on_rails > 0) return run_on_rails(command);
    if (command.varies_encoders) {
        const auto& methods = command.run.selection.methods;
        return study::run_encoder_study(methods.empty() ? "implicit" : methods.front(), command.run.out,
                                        surroundings());
    }
    if (command.varies_springs) return study::run_spring_study(command.run.out, surroundings());
    if (command.varies_frequency) return study::run_response_study(command.run.out, surroundings());
    if (command.runs_sites) {
        study::SiteStudyOptions sites = command.sites;
        sites.has_edge_forces = command.run.selection.has_edge_forces;
        sites.out = command.run.out;
        sites.quick = command.run.selection.quick;
        sites.jobs = command.run.jobs;
        if (!command.run.selection.methods.empty()) sites.methods = command.run.selection.methods;
        study::run_site_study(sites, surroundings());
        return;
    }
    if (!command.merge.empty()) {
        study::merge_stability_study(command.merge, command.run.out, surroundings());
        return;
    }
    const auto now_s = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    study::SceneCache cache;
    study::run_stability_study(
        command.run, [&](const study::MapCase& c) { return study::run_map_case(c, cache); }, now_s,
        surroundings());
}

void run(const osteomill::study::PolishingStudyOptions& options) {
    osteomill::study::require_charts();
    osteomill::study::make_folder(options.out);
    osteomill::study::run_polishing_study(options, surroundings());
}

void run(const osteomill::study::RenderStudyOptions& options) {
    osteomill::study::require_charts();
    osteomill::study::make_folder(options.out);
    osteomill::study::run_render_study(options, surroundings());
}

void run(const osteomill::study::RealtimeStudyOptions& options) {
    osteomill::study::require_charts();
    osteomill::study::make_folder(options.out);
    osteomill::study::run_realtime_study(options, surroundings());
}

void run(const osteomill::study::CalibrationCommand& command) {
    if (command.designs) {
        osteomill::study::DesignOptions design = command.design;
        design.out = command.out;
        osteomill::study::design_runs(design, surroundings());
    } else {
        osteomill::study::require_charts();
        osteomill::study::calibrate({.data = command.data, .out = command.out}, surroundings());
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Studies of the simulator: numbers and charts.", "osteomill_study");
    app.set_version_flag("--version", OSTEOMILL_VERSION);
    ForceOptions force;
    add_force(app, force);
    osteomill::study::StabilityCommand stability;
    const CLI::App* const is_stability = osteomill::study::add_stability(app, stability);
    osteomill::study::PolishingStudyOptions polishing;
    const CLI::App* const is_polishing = osteomill::study::add_polishing(app, polishing);
    osteomill::study::RenderStudyOptions render;
    const CLI::App* const is_render = osteomill::study::add_render(app, render);
    osteomill::study::RealtimeStudyOptions realtime;
    const CLI::App* const is_realtime = osteomill::study::add_realtime(app, realtime);
    osteomill::study::CalibrationCommand calibration;
    const CLI::App* const is_calibration = osteomill::study::add_calibration(app, calibration);
    osteomill::study::SessionsStudyOptions sessions;
    sessions.version = OSTEOMILL_VERSION;
    osteomill::study::BridgeStudyOptions bridge;
    const CLI::App* const is_bridge = osteomill::study::add_bridge(app, bridge);
    const CLI::App* const is_sessions = osteomill::study::add_sessions(app, sessions);
    try {
        osteomill::parse_arguments(app, argc, argv);
        if (app.got_subcommand("force") && app.get_subcommand("force")->count("--voxel-mm") > 0 &&
            force.cases.empty() && !force.random)
            throw CLI::RequiresError("--voxel-mm", "--cases or --random");
        if (app.get_subcommands().empty())
            throw CLI::RequiredError(
                "a study to run: force, stability, polishing, render, realtime, bridge, calibrate or "
                "sessions");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "osteomill_study: " << osteomill::printable(error.what()) << " (see --help)\n";
        return exit_usage;
    }
    try {
        if (is_stability->parsed())
            run(stability);
        else if (is_polishing->parsed())
            run(polishing);
        else if (is_render->parsed())
            run(render);
        else if (is_realtime->parsed())
            run(realtime);
        else if (is_calibration->parsed())
            run(calibration);
        else if (is_bridge->parsed())
            osteomill::study::run_bridge_study(bridge, surroundings());
        else if (is_sessions->parsed())
            osteomill::study::run_sessions_study(sessions, surroundings());
        else
            run(force);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "osteomill_study: " << osteomill::printable(error.what()) << '\n';
        return exit_failure;
    }
}
