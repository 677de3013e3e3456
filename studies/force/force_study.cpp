#include "studies/force/force_study.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/output/study_run.h"
#include "common/program/option_checks.h"
#include "common/text/foreign_json.h"
#include "studies/force/case_report.h"
#include "studies/force/contact_curves.h"
#include "studies/force/force_curves.h"
#include "studies/force/random_motions.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// What random motions to draw.
struct RandomMotionsToDraw {
    int count = 500;
    std::uint64_t seed = 1;
    double voxel_mm = 0.1;
    std::optional<double> depth_mm{};  ///< of all; without, each has its own
    bool has_edge_forces = false;
    bool has_heads = false;  ///< other than balls
};

struct ForceOptions {
    std::filesystem::path out = "study/force";
    std::filesystem::path cases{};
    SteadyRun run{};
    std::optional<int> random{};
    RandomMotionsToDraw drawn{};
    bool quick = false;  ///< fewer points and shorter runs: a minute at most
};

/// Random motions, their table and how they did.
class RandomPart {
  public:
    RandomPart(const RandomMotionsToDraw& options, StudyRun& run)
        : options_(options), motions_(drawn(options)), planned_(run.plan(motions_, name_of, measured)) {}

    ordered_json report(const StudyRun& run) const {
        std::vector<RandomResult> results = planned_.outcomes();
        for (std::size_t i = 0; i < results.size(); ++i) results[i].motion = motions_[i];
        run.write(table_of(results), "random");
        ordered_json summary{{"seed", options_.seed},
                             {"voxel_mm", options_.voxel_mm},
                             {"edge_forces", options_.has_edge_forces},
                             {"heads", options_.has_heads}};
        summary.update(summary_of(results));
        const auto found = [&](const char* key) { return summary[key].get<double>(); };
        run.say(
            "{} motions of seed {}: error median {:.2f} %, 90 % within {:.2f}, 95 % within {:.2f}, 99 % "
            "within "
            "{:.2f}, "
            "worst {:.2f} %; along the surface error median {:.2f} %, 90 % within {:.2f}, ripple 90 % within "
            "{:.2f} (from 5 mm/s on {:.2f}), "
            "worst {:.2f} %; means over 10 ms there 95 % within {:.2f} %, largest step at 1 kHz {:.2f} times "
            "the "
            "mean "
            "(99 % under {:.2f})",
            results.size(), options_.seed, found("median_error_percent"), found("p90_error_percent"),
            found("p95_error_percent"), found("p99_error_percent"), found("max_error_percent"),
            found("along_median_error_percent"), found("along_p90_error_percent"),
            found("ripple_p90_percent"), found("ripple_p90_from_5_mm_per_s_percent"),
            found("ripple_max_percent"), found("window_p95_percent"), found("largest_step_max"),
            found("largest_step_p99"));
        return summary;
    }

  private:
    static std::vector<RandomMotion> drawn(const RandomMotionsToDraw& options) {
        auto motions = random_motions(options.count, options.seed, options.voxel_mm);
        if (options.depth_mm) set_depth(motions, *options.depth_mm);
        if (options.has_edge_forces) draw_edge_forces(motions, options.seed);
        if (options.has_heads) draw_heads(motions, options.seed);
        return motions;
    }
    static std::string name_of(const RandomMotion& motion) { return motion.motion.name; }
    static RandomResult measured(const RandomMotion& motion) { return measure(motion, voxel_model()); }

    RandomMotionsToDraw options_;
    std::vector<RandomMotion> motions_;
    PlannedCases<RandomResult> planned_;
};

void run_cases(const ForceOptions& options, const StudySurroundings& surroundings) {
    const auto cases = read_steady_cases(options.cases);
    StudyRun run(options.out, surroundings);
    const auto planned = run.plan(
        cases, [](const SteadyCase& c) { return c.name; },
        [&](const SteadyCase& c) { return report_of(c, options.run, voxel_model()).dump(); });
    if (!run.perform()) return;
    ordered_json reports = ordered_json::array();
    for (const std::string& report : planned.outcomes())
        reports.push_back(parse_foreign_json<ordered_json>(report, "the report of a case"));
    run.write(reports, "cases");
    run.say("{} cases in {}", cases.size(), (options.out / "cases.json").string());
}

void run_random_motions(const ForceOptions& options, const StudySurroundings& surroundings) {
    RandomMotionsToDraw drawn = options.drawn;
    drawn.count = *options.random;
    drawn.voxel_mm = options.run.voxel_mm;
    StudyRun run(options.out, surroundings);
    const RandomPart random(drawn, run);
    if (!run.perform()) return;
    run.write(random.report(run), "random");
}

void run_whole_study(const ForceOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    StudyRun run(options.out, surroundings);
    const RandomPart random({.count = options.quick ? 60 : 500}, run);
    const auto plan_curve = [&](const std::vector<CurveCase>& curve) {
        return run.plan(
            curve, [](const CurveCase& c) { return c.motion.name; },
            [quick = options.quick](const CurveCase& c) { return measure(c, quick); });
    };
    const auto by_depth = plan_curve(depth_curve());
    const auto by_feed = plan_curve(feed_curve());
    const auto by_rpm = plan_curve(rpm_curve());
    const auto contact = run.plan(
        contact_depths_mm(options.quick), [](double mm) { return fmt::format("contact at {} mm", mm); },
        measure_contact);
    if (!run.perform()) return;

    ordered_json found;
    found["random"] = random.report(run);
    run.write(table_of(by_depth.outcomes(), "depth_mm"), "curve_depth");
    run.write(table_of(by_feed.outcomes(), "feed_mm_per_s"), "curve_feed");
    run.write(table_of(by_rpm.outcomes(), "thousand_rpm"), "curve_rpm");
    run.write(table_of(contact.outcomes()), "contact");
    run.write(found, "force");
    run.draw({"curves", "contact"});
    run.say("force.json, tables (CSV) and charts (SVG) are in {}", options.out.string());
}

void perform(const ForceOptions& options, const StudySurroundings& surroundings) {
    if (!options.cases.empty())
        run_cases(options, surroundings);
    else if (options.random)
        run_random_motions(options, surroundings);
    else
        run_whole_study(options, surroundings);
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
    force->add_option("--seed", options.drawn.seed, "of the random motions")
        ->needs(random)
        ->capture_default_str();
    force
        ->add_option("--depth-mm", options.drawn.depth_mm, "of all random motions, in the place of their own")
        ->needs(random)
        ->check(within(0.001, 5.0));
    force
        ->add_flag("--edge-forces", options.drawn.has_edge_forces,
                   "burrs whose edges rub, by random coefficients")
        ->needs(random);
    force
        ->add_flag("--heads", options.drawn.has_heads,
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
    return {.subcommand = force,
            .run = [shared](const StudySurroundings& surroundings) { perform(*shared, surroundings); },
            .writes = {"cases.json", "cases-*.jsonl"}};
}

}  // namespace osteomill::study
