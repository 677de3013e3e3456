#include "studies/force/force_options.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "analysis/output/study_run.h"
#include "common/program/option_checks.h"
#include "studies/force/case_report.h"
#include "studies/force/force_study.h"

namespace osteomill::study {

namespace {

struct ForceOptions {
    std::filesystem::path out = "study/force";
    std::filesystem::path cases{};
    SteadyRun run{};
    std::optional<int> random{};
    std::uint64_t seed = 1;
    std::optional<double> depth_mm{};
    bool has_edge_forces = false;
    bool has_heads = false;
    bool quick = false;
};

void run_cases(const ForceOptions& options, const StudySurroundings& surroundings) {
    const auto cases = read_steady_cases(options.cases);
    StudyRun run(options.out, surroundings);
    const auto planned = run.plan(
        cases, [](const SteadyCase& c) { return c.name; },
        [&](const SteadyCase& c) { return report_of(c, options.run, voxel_model()).dump(); });
    if (!run.perform()) return;
    nlohmann::ordered_json reports = nlohmann::ordered_json::array();
    for (const std::string& report : planned.outcomes())
        reports.push_back(nlohmann::ordered_json::parse(report));
    run.write(reports, "cases");
    run.say("{} cases in {}", cases.size(), (options.out / "cases.json").string());
}

void perform(const ForceOptions& options, const StudySurroundings& surroundings) {
    if (!options.cases.empty())
        run_cases(options, surroundings);
    else if (options.random)
        run_random_motions({.out = options.out,
                            .count = *options.random,
                            .seed = options.seed,
                            .voxel_mm = options.run.voxel_mm,
                            .depth_mm = options.depth_mm,
                            .has_edge_forces = options.has_edge_forces,
                            .has_heads = options.has_heads},
                           surroundings);
    else
        run_force_study({.out = options.out, .quick = options.quick}, surroundings);
}

}  // namespace

StudyCommand add_force(CLI::App& app) {
    const auto shared = std::make_shared<ForceOptions>();
    ForceOptions& options = *shared;
    CLI::App* force =
        app.add_subcommand("force", "the milling force: voxel model against analytical reference");
    add_out(*force, options.out);
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
        ->check(within(0.001, 5.0));
    force->add_flag("--edge-forces", options.has_edge_forces, "burrs whose edges rub, by random coefficients")
        ->needs(random);
    force
        ->add_flag("--heads", options.has_heads,
                   "cylinders, cones, barrels and pears in the place of balls, of random proportions")
        ->needs(random);
    force->add_flag("--quick", options.quick, "fewer points, shorter runs: under a minute")
        ->excludes(cases)
        ->excludes(random);
    force->add_option("--voxel-mm", options.run.voxel_mm, "edge of a voxel, of --cases and --random")
        ->capture_default_str()
        ->check(within(0.01, 1.0));
    force->add_option("--milling-rate-hz", options.run.milling_rate_hz, "steps of the voxel model a second")
        ->needs(cases)
        ->capture_default_str()
        ->check(within(1.0, 100'000.0));
    force
        ->add_option("--travel-mm", options.run.travel_mm,
                     "way over which force is averaged, for motions along the surface (20 steps at least)")
        ->needs(cases)
        ->capture_default_str()
        ->check(within(0.01, 100.0));
    force->parse_complete_callback([shared, force] {
        if (force->count("--voxel-mm") > 0 && shared->cases.empty() && !shared->random)
            throw CLI::RequiresError("--voxel-mm", "--cases or --random");
    });
    return {force, [shared](const StudySurroundings& surroundings) { perform(*shared, surroundings); }};
}

}  // namespace osteomill::study
