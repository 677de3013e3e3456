#include "studies/render/render_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "imaging/progress.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "studies/render/accuracy.h"
#include "studies/render/carved_sphere.h"
#include "studies/render/frame_scaling.h"
#include "studies/render/full_rate/full_rate.h"
#include "studies/render/gallery.h"
#include "studies/render/light_cost.h"
#include "studies/render/normals.h"
#include "studies/render/upload_cost.h"
#include "studies/render/zooms.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

constexpr double full_quality_goal_db = 40.0;

ordered_json json_of(const Cost& cost) {
    return {{"wall_ms", cost.wall_ms}, {"cpu_ms", cost.cpu_ms}};
}

/// One run of the study: what was asked, where it goes.
class RenderStudy {
    // A chapter with a bar of its own. First in the class, because what it returns is deduced.
    template <typename Work>
    auto with_progress(const std::string& title, Work&& work) const {
        ProgressLine line(surroundings_.progress, surroundings_.is_terminal, title);
        return work(line.reporter());
    }

  public:
    RenderStudy(const RenderStudyOptions& options, const StudySurroundings& surroundings)
        : options_(options),
          surroundings_(surroundings),
          context_(options.gpu),
          size_px_(options.size_px.value_or(options.quick ? glm::ivec2(240, 180) : glm::ivec2(640, 480))) {}

    void run() {
        ordered_json found;
        found["gl_renderer"] = gl::renderer_name();
        say("drawn by {}", gl::renderer_name());
        // For the charts' titles.
        write(gl::renderer_name() + "\n", "gl_renderer.txt");
        if (options_.zooms_only) {
            zooms();
            return;
        }

        found["surfaces"] = surfaces();
        const TrialBone tooth =
            with_progress("phantom", [](const Progress& progress) { return done(tooth_trial(), progress); });
        std::vector<DrawingPoint> points = accuracy_of(tooth);
        found["upload"] = uploads(tooth);
        found["light"] = light(tooth);
        found["frames"] = frames(tooth);
        gallery(tooth);
        if (options_.scans && !options_.quick) {
            const TrialBone skull = with_progress("skull", [this](const Progress& progress) {
                return done(skull_trial(*options_.scans, options_.out), progress);
            });
            const std::vector<DrawingPoint> more = accuracy_of(skull);
            points.insert(points.end(), more.begin(), more.end());
            gallery(skull);
        } else {
            say("real CT skipped: {}",
                options_.quick ? "--quick" : "OSTEOMILL_SCANS does not name the folder of trial scans");
        }
        write(csv_of(points), "accuracy.csv");
        found["accuracy"] = json_of_accuracy(points);
        write_json(found, options_.out / "render.json");
        for (const char* chart : {"render_accuracy", "render_scaling", "render_upload"})
            draw_chart(chart_scripts(), chart, options_.out);
        say("render.json, tables (CSV), charts (SVG) and pictures (PNG) are in {}", options_.out.string());
    }

  private:
    static TrialBone done(TrialBone trial, const Progress& progress) {
        progress(1.0);
        return trial;
    }

    template <typename... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
        surroundings_.said << fmt::format(format, std::forward<Arguments>(arguments)...) << '\n';
    }

    void write(const std::string& table, const std::string& name) const {
        write_text(table, options_.out / name);
    }

    /// Normals, and how smooth a cut looks.
    ordered_json surfaces() const {
        constexpr unsigned seed = 1;
        const std::vector<NormalError> errors = with_progress("surfaces", [](const Progress& progress) {
            std::vector<NormalError> measured = normal_errors(seed);
            progress(1.0);
            return measured;
        });
        write(csv_of(errors), "normals.csv");
        ordered_json normals = ordered_json::array();
        for (const NormalError& e : errors) {
            say("normals, {}: {}: {:.2f} degrees in the median, {:.2f} at the 95th percentile{}", e.surface,
                e.method, e.median_deg, e.p95_deg, e.is_default ? " (default)" : "");
            normals.push_back({{"surface", e.surface},
                               {"method", e.method},
                               {"is_default", e.is_default},
                               {"median_deg", e.median_deg},
                               {"p95_deg", e.p95_deg}});
        }
        const double wall_p95_deg = carved_sphere_normals_p95_deg();
        say("wall cut by a sphere: normals {:.2f} degrees at the 95th percentile (goal: within 1)",
            wall_p95_deg);
        ordered_json pictures = ordered_json::array();
        for (const double px_per_voxel : {4.0, 10.0, 20.0}) {
            const double found_db = carved_sphere_psnr_db(px_per_voxel);
            say("wall cut by a sphere, {} pixels a voxel: {:.1f} dB against the analytic picture (goal: 42)",
                px_per_voxel, found_db);
            pictures.push_back({{"px_per_voxel", px_per_voxel}, {"psnr_db", found_db}});
        }
        return {{"normals", normals}, {"cut_wall", {{"p95_deg", wall_p95_deg}, {"pictures", pictures}}}};
    }

    std::vector<DrawingPoint> accuracy_of(const TrialBone& trial) const {
        const auto points = with_progress("accuracy, " + trial.name, [&](const Progress& progress) {
            return measure(trial, drawing_settings(options_.quick), size_px_, options_.quick, progress);
        });
        for (const DrawingPoint& p : points)
            if (p.setting.is_default)
                say("{}, {}: full quality {:.1f} dB (goal {:.0f}), SSIM {:.4f}, {:.0f} ms a frame of {} x {}",
                    p.bone, p.view, p.psnr_db, full_quality_goal_db, p.ssim, p.frame.wall_ms, size_px_.x,
                    size_px_.y);
        return points;
    }

    ordered_json json_of_accuracy(const std::vector<DrawingPoint>& points) const {
        ordered_json json = ordered_json::array();
        for (const DrawingPoint& p : points)
            json.push_back({{"bone", p.bone},
                            {"view", p.view},
                            {"family", p.setting.family},
                            {"label", p.setting.label},
                            {"is_default", p.setting.is_default},
                            {"frame", json_of(p.frame)},
                            {"psnr_db", p.psnr_db},
                            {"ssim", p.ssim},
                            {"psnr_trilinear_db", p.psnr_trilinear_db}});
        return json;
    }

    ordered_json uploads(const TrialBone& trial) const {
        const auto rows = with_progress("upload", [&](const Progress& progress) {
            return measure_uploads(trial, options_.quick, progress);
        });
        write(csv_of(rows), "upload.csv");
        ordered_json json = ordered_json::array();
        for (const UploadRow& r : rows) {
            if (r.diameter_mm == 5.0)
                say("a carve by the 5 mm burr: {} bricks, {:.2f} ms to upload (goal: below 1), {:.2f} ms "
                    "with "
                    "surface voxels",
                    r.bricks, r.gradient.wall_ms, r.surface_voxels.wall_ms);
            json.push_back({{"diameter_mm", r.diameter_mm},
                            {"bricks", r.bricks},
                            {"gradient", json_of(r.gradient)},
                            {"surface_voxels", json_of(r.surface_voxels)}});
        }
        return json;
    }

    ordered_json light(const TrialBone& trial) const {
        const std::vector<LightRow> rows = with_progress("light", [&](const Progress& progress) {
            std::vector<LightRow> measured = light_costs(trial, size_px_, options_.quick ? 5 : 25);
            progress(1.0);
            return measured;
        });
        write(csv_of(rows), "light.csv");
        ordered_json json = ordered_json::array();
        for (const LightRow& row : rows) {
            say("light: {}: {:.2f} ms, {:.2f} ms of all threads", row.what, row.cost.wall_ms,
                row.cost.cpu_ms);
            json.push_back({{"what", row.what}, {"cost", json_of(row.cost)}});
        }
        return json;
    }

    ordered_json frames(const TrialBone& trial) const {
        const auto by_volume = with_progress("volume size", [&](const Progress& progress) {
            return frames_by_volume(size_px_, options_.quick, progress);
        });
        const auto by_window = with_progress("window size", [&](const Progress& progress) {
            return frames_by_window(trial, options_.quick, progress);
        });
        write(csv_of(by_volume, "edge_voxels"), "frames_by_volume.csv");
        write(csv_of(by_window, "kilopixels"), "frames_by_window.csv");
        const auto rows = [](const std::vector<ScaledFrames>& measured, const char* at) {
            ordered_json json = ordered_json::array();
            for (const ScaledFrames& r : measured)
                json.push_back({{at, r.at},
                                {"raycast", json_of(r.raycast)},
                                {"raycast_surface_voxels", json_of(r.raycast_surface_voxels)},
                                {"slices", json_of(r.slices)}});
            return json;
        };
        return {{"by_volume", rows(by_volume, "edge_voxels")}, {"by_window", rows(by_window, "kilopixels")}};
    }

    void zooms() const {
        const std::filesystem::path folder = options_.out / "zooms";
        make_folder(folder);
        with_progress("zooms", [&](const Progress& progress) {
            write_zooms(size_px_, folder, options_.scans, progress);
            progress(1.0);
        });
        say("pictures (PNG) of every bone at three zooms are in {}{}", folder.string(),
            options_.scans ? ""
                           : "; real CT skipped: OSTEOMILL_SCANS does not name the folder of trial scans");
    }

    void gallery(const TrialBone& trial) const {
        const std::filesystem::path folder = options_.out / "pictures";
        make_folder(folder);
        with_progress("pictures, " + trial.name, [&](const Progress& progress) {
            write_gallery(trial, size_px_, folder);
            progress(1.0);
        });
    }

    const RenderStudyOptions& options_;
    const StudySurroundings& surroundings_;
    gl::OffscreenContext context_;
    glm::ivec2 size_px_;
};

}  // namespace

void run_render_study(const RenderStudyOptions& options, const StudySurroundings& surroundings) {
    if (options.full_rate_only)
        measure_full_rate(
            {.out = options.out, .size_px = options.size_px, .frames = options.frames, .gpu = options.gpu},
            surroundings);
    else
        RenderStudy(options, surroundings).run();
}

}  // namespace osteomill::study
