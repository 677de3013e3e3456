#include "studies/force/force_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/output/study_run.h"
#include "studies/force/contact_curves.h"
#include "studies/force/force_curves.h"
#include "studies/force/random_motions.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// Random motions, their table and how they did.
class RandomPart {
  public:
    RandomPart(const RandomStudyOptions& options, StudyRun& run)
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
    static std::vector<RandomMotion> drawn(const RandomStudyOptions& options) {
        auto motions = random_motions(options.count, options.seed, options.voxel_mm);
        if (options.depth_mm) set_depth(motions, *options.depth_mm);
        if (options.has_edge_forces) draw_edge_forces(motions, options.seed);
        if (options.has_heads) draw_heads(motions, options.seed);
        return motions;
    }
    static std::string name_of(const RandomMotion& motion) { return motion.motion.name; }
    static RandomResult measured(const RandomMotion& motion) { return measure(motion, voxel_model()); }

    RandomStudyOptions options_;
    std::vector<RandomMotion> motions_;
    PlannedCases<RandomResult> planned_;
};

}  // namespace

void run_random_motions(const RandomStudyOptions& options, const StudySurroundings& surroundings) {
    StudyRun run(options.out, surroundings);
    const RandomPart random(options, run);
    if (!run.perform()) return;
    run.write(random.report(run), "random");
}

void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    StudyRun run(options.out, surroundings);
    const RandomPart random({.out = options.out, .count = options.quick ? 60 : 500}, run);
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

}  // namespace osteomill::study
