#include "studies/render/render_study.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "common/program/option_checks.h"
#include "render_client/ui/options.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "studies/render/accuracy.h"
#include "studies/render/carved_sphere.h"
#include "studies/render/full_rate/full_rate.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

struct RenderStudyOptions {
    std::filesystem::path out = "study/render";
    bool full_rate_only = false;                   ///< only frames a second in a large window, full_rate.h
    std::optional<int> frames{};                   ///< of these, in a row of the table; none: 600
    std::optional<int> gpu{};                      ///< draw on this GPU of several, from 0
    bool quick = false;                            ///< fewer settings, smaller pictures: under a minute
    std::optional<glm::ivec2> size_px{};           ///< of the pictures; none: 640 x 480, 240 x 180 if quick
    std::optional<std::filesystem::path> scans{};  ///< a folder of trial scans; none: the phantom alone
};

constexpr double full_quality_goal_db = 40.0;
const std::vector<double> px_per_voxel{4.0, 10.0, 20.0};

/// Settings of one look, to be drawn in a view of a bone.
struct DrawingCase {
    std::string bone;
    std::string view;
    std::vector<DrawingSetting> settings;
};

std::vector<DrawingCase> drawing_cases(const std::string& bone, bool quick) {
    std::vector<DrawingCase> cases;
    for (const auto& settings : by_look(drawing_settings(quick)))
        for (const char* const view : {"overview", "close-up"})
            if (!quick || view == std::string("overview")) cases.push_back({bone, view, settings});
    return cases;
}

std::string name_of(const DrawingCase& c) {
    return c.bone + ", " + c.view + ", " + c.settings.front().family;
}

/// How smooth a cut looks.
ordered_json cut_wall_figures(double p95_deg, const std::vector<double>& found_db, const StudyRun& run) {
    run.say("wall cut by a sphere: normals {:.2f} degrees at the 95th percentile (goal: within 1)", p95_deg);
    ordered_json pictures = ordered_json::array();
    for (std::size_t i = 0; i < found_db.size(); ++i) {
        run.say("wall cut by a sphere, {} pixels a voxel: {:.1f} dB against the analytic picture (goal: 42)",
                px_per_voxel[i], found_db[i]);
        pictures.push_back({{"px_per_voxel", px_per_voxel[i]}, {"psnr_db", found_db[i]}});
    }
    return {{"p95_deg", p95_deg}, {"pictures", pictures}};
}

void run_render_study(const RenderStudyOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    if (options.full_rate_only)
        return measure_full_rate(
            {.out = options.out, .size_px = options.size_px, .frames = options.frames, .gpu = options.gpu},
            surroundings);
    StudyRun run(options.out, surroundings);
    const gl::OffscreenContext context(options.gpu);
    const glm::ivec2 size_px =
        options.size_px.value_or(options.quick ? glm::ivec2(240, 180) : glm::ivec2(640, 480));
    run.say("drawn by {}", gl::renderer_name());
    // For the chart's title.
    write_text(gl::renderer_name() + "\n", options.out / "gl_renderer.txt");
    TrialBones bones(options.scans, options.out);

    std::vector<DrawingCase> cases = drawing_cases(tooth_trial, options.quick);
    const bool has_skull = options.scans && !options.quick;
    if (has_skull)
        for (DrawingCase& c : drawing_cases(skull_trial, options.quick)) cases.push_back(std::move(c));
    const auto wall_normals = run.plan(
        std::vector{0}, [](int) { return "normals of a cut wall"; },
        [](int) { return carved_sphere_normals_p95_deg(); });
    const auto wall_pictures = run.plan(
        px_per_voxel, [](double px) { return fmt::format("cut wall at {} pixels a voxel", px); },
        carved_sphere_psnr_db);
    const auto planned = run.plan(cases, name_of, [&](const DrawingCase& c) {
        const TrialBone& trial = bones[c.bone];
        const Camera& camera = c.view == "overview" ? trial.overview : trial.close_up;
        return measure(trial, camera, c.settings, size_px, options.quick);
    });
    if (!run.perform()) return;

    ordered_json found{
        {"gl_renderer", gl::renderer_name()},
        {"cut_wall", cut_wall_figures(wall_normals.outcomes().front(), wall_pictures.outcomes(), run)}};
    std::vector<DrawingPoint> points;
    auto c = cases.begin();
    for (const std::vector<Drawn>& drawn : planned.outcomes()) {
        for (std::size_t i = 0; i < drawn.size(); ++i)
            points.push_back({c->bone, c->view, c->settings[i], drawn[i]});
        ++c;
    }
    for (const DrawingPoint& p : points)
        if (p.setting.is_default)
            run.say("{}, {}: full quality {:.1f} dB (goal {:.0f}), SSIM {:.4f}, {:.0f} ms a frame of {} x {}",
                    p.bone, p.view, p.drawn.psnr_db, full_quality_goal_db, p.drawn.ssim,
                    p.drawn.frame.wall_ms, size_px.x, size_px.y);
    if (!has_skull)
        run.say("real CT skipped: {}",
                options.quick ? "--quick" : "OSTEOMILL_SCANS does not name the folder of trial scans");
    const Table table = table_of(points);
    run.write(table, "accuracy");
    found["accuracy"] = table.json();
    run.write(found, "render");
    run.draw({"render_accuracy"});
    run.say("render.json, accuracy.csv and render_accuracy.svg are in {}", options.out.string());
}

}  // namespace

StudyCommand add_render(CLI::App& app) {
    const auto shared = std::make_shared<RenderStudyOptions>();
    RenderStudyOptions& options = *shared;
    if (const char* const scans = std::getenv("OSTEOMILL_SCANS")) options.scans = scans;
    CLI::App* render =
        app.add_subcommand("render", "the pictures: frame time against accuracy, how smooth a cut looks");
    add_out(*render, options.out);
    render
        ->add_option_function<int>(
            "--width-px",
            [&options](int width_px) { options.size_px = glm::ivec2(width_px, 3 * width_px / 4); },
            "width of the pictures, 4:3 (640; 240 with --quick)")
        ->check(CLI::Range(64, 4096));
    auto* const full_rate = render->add_flag(
        "--full-rate", options.full_rate_only,
        "only what a graphics card draws in a second at 2560 x 1440, orbiting and carving, "
        "with uploads and texture memory; smaller and shorter where a software rasteriser draws");
    add_read(
        *render, "--size-px", [&options](const std::string& text) { options.size_px = parse_size(text); },
        "size of these pictures (2560x1440; 640x360 by a software rasteriser)")
        ->needs(full_rate)
        ->excludes("--width-px")
        ->type_name("WxH");
    render->add_option("--frames", options.frames, "of each of their rows (600; 8 by a software rasteriser)")
        ->needs(full_rate)
        ->check(CLI::Range(1, 1'000'000));
    render
        ->add_option(
            "--gpu", options.gpu,
            "draw on this GPU of several, counted from 0 (the first; where there is none, Mesa's software "
            "rasteriser)")
        ->check(CLI::Range(0, 63));
    render->add_flag("--quick", options.quick, "fewer settings, smaller pictures: under a minute");
    return {
        .subcommand = render,
        .run = [shared](const StudySurroundings& surroundings) { run_render_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
