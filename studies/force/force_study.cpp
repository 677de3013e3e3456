#include "studies/force/force_study.h"

#include <nlohmann/json.hpp>

#include "analysis/output/study_run.h"
#include "studies/force/contact_curves.h"
#include "studies/force/force_curves.h"
#include "studies/force/memory.h"
#include "studies/force/random_motions.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// Measures random motions, writes their table and says how they did.
ordered_json measure_random(const RandomStudyOptions& options, const StudyRun& run) {
    auto motions = random_motions(options.count, options.seed, options.voxel_mm);
    if (options.depth_mm) set_depth(motions, *options.depth_mm);
    if (options.has_edge_forces) draw_edge_forces(motions, options.seed);
    if (options.has_heads) draw_heads(motions, options.seed);
    std::vector<RandomResult> results;
    run.chapter("random", [&](const ReportProgress& progress) {
        for (const RandomMotion& motion : motions) {
            results.push_back(measure(motion, voxel_model()));
            progress(static_cast<double>(results.size()) / options.count);
        }
    });
    run.write(table_of(results), "random");
    ordered_json summary{{"seed", options.seed},
                         {"voxel_mm", options.voxel_mm},
                         {"edge_forces", options.has_edge_forces},
                         {"heads", options.has_heads}};
    summary.update(summary_of(results));
    const auto found = [&](const char* key) { return summary[key].get<double>(); };
    run.say(
        "{} motions of seed {}: error median {:.2f} %, 90 % within {:.2f}, 95 % within {:.2f}, 99 % within "
        "{:.2f}, "
        "worst {:.2f} %; along the surface error median {:.2f} %, 90 % within {:.2f}, ripple 90 % within "
        "{:.2f}, "
        "worst {:.2f} %; means over 10 ms there 95 % within {:.2f} %, largest step at 1 kHz {:.2f} times the "
        "mean "
        "(99 % under {:.2f})",
        results.size(), options.seed, found("median_error_percent"), found("p90_error_percent"),
        found("p95_error_percent"), found("p99_error_percent"), found("max_error_percent"),
        found("along_median_error_percent"), found("along_p90_error_percent"), found("ripple_p90_percent"),
        found("ripple_max_percent"), found("window_p95_percent"), found("largest_step_max"),
        found("largest_step_p99"));
    return summary;
}

}  // namespace

void run_random_motions(const RandomStudyOptions& options, const StudySurroundings& surroundings) {
    const StudyRun run(options.out, surroundings);
    run.write(measure_random(options, run), "random");
}

void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings) {
    const StudyRun run(options.out, surroundings);
    ordered_json found;
    found["random"] = measure_random({.out = options.out, .count = options.quick ? 60 : 500}, run);

    const ForceCurves curves = run.chapter(
        "curves", [&](const ReportProgress& progress) { return measure_curves(options.quick, progress); });
    run.write(table_of(curves.depth, "depth_mm"), "curve_depth");
    run.write(table_of(curves.feed, "feed_mm_per_s"), "curve_feed");
    run.write(table_of(curves.rpm, "thousand_rpm"), "curve_rpm");

    const ContactCurves contact = run.chapter(
        "contact", [&](const ReportProgress& progress) { return measure_contact(options.quick, progress); });
    run.write(table_of(contact), "contact");
    for (std::size_t i = 0; i < contact.models.size(); ++i)
        found["contact"].push_back({{"model", contact.models[i]}, {"step_us_p50", contact.step_us[i]}});

    const Table scenes = table_of(weigh_scenes());
    run.write(scenes, "memory_scenes");
    found["memory"] = scenes.json();
    const MemoryRow watch = weigh_structures();
    run.write(table_of({watch}), "memory_structures");
    run.say("watching {} ({:.0f} mm^3): {:.1f} MiB, ready in {:.2f} s", watch.name, watch.bone_mm3,
            watch.mebibytes, watch.start_s);

    run.write(found, "force");
    run.draw({"curves", "contact"});
    run.say("force.json, tables (CSV) and charts (SVG) are in {}", options.out.string());
}

}  // namespace osteomill::study
