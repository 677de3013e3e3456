#include "studies/render/render_study.h"

#include <nlohmann/json.hpp>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "studies/render/accuracy.h"
#include "studies/render/carved_sphere.h"
#include "studies/render/full_rate/full_rate.h"
#include "studies/render/zooms.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

constexpr double full_quality_goal_db = 40.0;

/// How smooth a cut looks.
ordered_json measure_cut_wall(const StudyRun& run) {
    const double p95_deg = carved_sphere_normals_p95_deg();
    run.say("wall cut by a sphere: normals {:.2f} degrees at the 95th percentile (goal: within 1)", p95_deg);
    ordered_json pictures = ordered_json::array();
    for (const double px_per_voxel : {4.0, 10.0, 20.0}) {
        const double found_db = carved_sphere_psnr_db(px_per_voxel);
        run.say("wall cut by a sphere, {} pixels a voxel: {:.1f} dB against the analytic picture (goal: 42)",
                px_per_voxel, found_db);
        pictures.push_back({{"px_per_voxel", px_per_voxel}, {"psnr_db", found_db}});
    }
    return {{"p95_deg", p95_deg}, {"pictures", pictures}};
}

void measure_accuracy(const TrialBone& trial, const glm::ivec2& size_px, bool quick, const StudyRun& run,
                      std::vector<DrawingPoint>& points) {
    const auto found = run.chapter("accuracy, " + trial.name, [&](const ReportProgress& progress) {
        return measure(trial, drawing_settings(quick), size_px, quick, progress);
    });
    for (const DrawingPoint& p : found)
        if (p.setting.is_default)
            run.say("{}, {}: full quality {:.1f} dB (goal {:.0f}), SSIM {:.4f}, {:.0f} ms a frame of {} x {}",
                    p.bone, p.view, p.psnr_db, full_quality_goal_db, p.ssim, p.frame.wall_ms, size_px.x,
                    size_px.y);
    points.insert(points.end(), found.begin(), found.end());
}

void draw_zooms(const RenderStudyOptions& options, const glm::ivec2& size_px, const StudyRun& run) {
    const std::filesystem::path folder = options.out / "zooms";
    make_folder(folder);
    run.chapter("zooms", [&](const ReportProgress& progress) {
        write_zooms(size_px, folder, options.scans, progress);
    });
    run.say(
        "pictures (PNG) of every bone at three zooms are in {}{}", folder.string(),
        options.scans ? "" : "; real CT skipped: OSTEOMILL_SCANS does not name the folder of trial scans");
}

}  // namespace

void run_render_study(const RenderStudyOptions& options, const StudySurroundings& surroundings) {
    if (options.full_rate_only)
        return measure_full_rate(
            {.out = options.out, .size_px = options.size_px, .frames = options.frames, .gpu = options.gpu},
            surroundings);
    const StudyRun run(options.out, surroundings);
    const gl::OffscreenContext context(options.gpu);
    const glm::ivec2 size_px =
        options.size_px.value_or(options.quick ? glm::ivec2(240, 180) : glm::ivec2(640, 480));
    run.say("drawn by {}", gl::renderer_name());
    // For the chart's title.
    write_text(gl::renderer_name() + "\n", options.out / "gl_renderer.txt");
    if (options.zooms_only) return draw_zooms(options, size_px, run);

    ordered_json found{{"gl_renderer", gl::renderer_name()}, {"cut_wall", measure_cut_wall(run)}};
    std::vector<DrawingPoint> points;
    measure_accuracy(tooth_trial(), size_px, options.quick, run, points);
    if (options.scans && !options.quick)
        measure_accuracy(skull_trial(*options.scans, options.out), size_px, options.quick, run, points);
    else
        run.say("real CT skipped: {}",
                options.quick ? "--quick" : "OSTEOMILL_SCANS does not name the folder of trial scans");
    const Table table = table_of(points);
    run.write(table, "accuracy");
    found["accuracy"] = table.json();
    run.write(found, "render");
    run.draw({"render_accuracy"});
    run.say("render.json, accuracy.csv and render_accuracy.svg are in {}", options.out.string());
}

}  // namespace osteomill::study
