#include "studies/render/full_rate/full_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "common/statistics/percentile.h"
#include "render_client/volume/gl/graphics_devices.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "studies/render/full_rate/carve_upload.h"
#include "studies/render/full_rate/window_frames.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

constexpr glm::ivec2 full_size_px(2560, 1440);
constexpr glm::ivec2 software_size_px(640, 360);
constexpr int full_frames = 600;
constexpr int software_frames = 8;
constexpr int uploads = 50;
constexpr double bytes_per_mib = 1024.0 * 1024.0;

struct Row {
    std::string phantom{};
    std::string motion{};
    FrameMilliseconds frames{};
};

class FullRate {
  public:
    FullRate(const FullRateOptions& options, const StudySurroundings& surroundings)
        : options_(options),
          run_(options.out, surroundings),
          context_(options.gpu),
          gl_renderer_(gl::renderer_name()),
          is_software_(gl::is_software_renderer(gl_renderer_)),
          size_px_(options.size_px.value_or(is_software_ ? software_size_px : full_size_px)),
          frames_(options.frames.value_or(is_software_ ? software_frames : full_frames)) {}

    void run() {
        say_what_is_measured();
        ordered_json found{{"gl_renderer", gl_renderer_},
                           {"is_software_renderer", is_software_},
                           {"size_px", {size_px_.x, size_px_.y}},
                           {"frames_of_a_row", frames_}};
        const std::vector<std::string> phantoms{"tooth", "head"};
        const auto uploaded = run_.plan(
            phantoms, [](const std::string& phantom) { return phantom + ", uploads"; },
            [this](const std::string& phantom) {
                return upload_carves(phantom, is_software_ ? frames_ : uploads);
            });
        const auto drawn = run_.plan(
            phantoms, [](const std::string& phantom) { return phantom + ", window"; },
            [this](const std::string& phantom) {
                return draw_window(phantom, size_px_, frames_, options_.out / ("window_" + phantom + ".png"));
            });
        if (!run_.perform()) return;
        const std::vector<CarveUpload> uploads_of = uploaded.outcomes();
        const std::vector<WindowFrames> frames_of = drawn.outcomes();
        for (std::size_t i = 0; i < phantoms.size(); ++i) {
            found["bones"][phantoms[i]] = upload_figures(phantoms[i], uploads_of[i]);
            add_rows(phantoms[i], frames_of[i]);
        }
        say("");
        say("{:<7}{:<21}{:>10}{:>9}{:>9}{:>9}{:>9}  {}", "bone", "motion", "frames/s", "p50 ms", "p99 ms",
            "GPU ms", "CPU ms", "GL renderer");
        Table table({"bone", "motion", "width_px", "height_px", "frames", "frames_per_s", "p50_ms", "p99_ms",
                     "gpu_p50_ms", "gpu_p99_ms", "cpu_p50_ms", "gl_renderer"});
        for (const Row& row : rows_) {
            const auto& [wall, gpu, cpu] = row.frames;
            say("{:<7}{:<21}{:>10.1f}{:>9.2f}{:>9.2f}{:>9.2f}{:>9.2f}  {}", row.phantom, row.motion,
                frames_per_s(row.frames), percentile(wall, 0.5), percentile(wall, 0.99), percentile(gpu, 0.5),
                percentile(cpu, 0.5), gl_renderer_);
            table.add({row.phantom, row.motion, size_px_.x, size_px_.y, wall.size(), frames_per_s(row.frames),
                       percentile(wall, 0.5), percentile(wall, 0.99), percentile(gpu, 0.5),
                       percentile(gpu, 0.99), percentile(cpu, 0.5), gl_renderer_});
        }
        found["rows"] = table.json();
        compare_eyes(found);
        write_text(gl_renderer_ + "\n", options_.out / "gl_renderer.txt");
        run_.write(table, "full_rate");
        run_.write(found, "full_rate");
        run_.draw({"render_full_rate"});
        say("full_rate.json, full_rate.csv, render_full_rate.svg and pictures (PNG) are in {}",
            options_.out.string());
    }

  private:
    template <typename... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
        run_.say(format, std::forward<Arguments>(arguments)...);
    }

    void say_what_is_measured() const {
        say("drawn by {}, {} x {}, {} frames a row, every pixel at full quality, each frame finished before "
            "the "
            "next",
            gl_renderer_, size_px_.x, size_px_.y, frames_);
        if (!is_software_) return;
        say("no GPU: a software rasteriser draws, and the goals are not for it");
        if (!options_.size_px || !options_.frames)
            say("reduced for it from {} x {} and {} frames a row; for all pixels and "
                "frames: --size-px {}x{} --frames {}",
                full_size_px.x, full_size_px.y, full_frames, full_size_px.x, full_size_px.y, full_frames);
    }

    ordered_json upload_figures(const std::string& phantom, const CarveUpload& found) const {
        ordered_json textures;
        std::string parts;
        for (const TextureSize& each : found.textures) {
            textures[each.name] = each.bytes;
            parts += fmt::format("{}{} {:.0f}", parts.empty() ? "" : ", ", each.name,
                                 static_cast<double>(each.bytes) / bytes_per_mib);
        }
        say("{}: {}{} ({} MiB)", phantom, description(found.plan),
            found.plan.coarsening == 1 ? ", of the bone itself" : "", parts);
        say("{}: upload of what the 5 mm burr cuts in a frame {:.3f} ms, p99 {:.3f}; of a ball of 5 mm at "
            "once, {} "
            "bricks, {:.3f} ms (goal on a GPU: below 0.2; {})",
            phantom, percentile(found.by_frame.wall, 0.5), percentile(found.by_frame.wall, 0.99),
            found.bricks_of_ball, percentile(found.by_ball.wall, 0.5), gl_renderer_);
        return {{"texture_bytes", found.plan.bytes},
                {"textures", textures},
                {"layout", found.plan.layout == BoneLayout::dense ? "dense" : "atlas"},
                {"times_coarser", found.plan.coarsening},
                {"has_smoothed_fractions", found.plan.smoothed},
                {"upload_of_frame", json_of(found.by_frame)},
                {"upload_of_5_mm_ball", json_of(found.by_ball)},
                {"bricks_of_5_mm_ball", found.bricks_of_ball}};
    }

    void add_rows(const std::string& phantom, const WindowFrames& drawn) {
        for (const auto& [motion, frames] :
             {std::pair{"orbit", &drawn.orbit}, std::pair{"carve", &drawn.carve},
              std::pair{"orbit side by side", &drawn.orbit_side_by_side},
              std::pair{"orbit quad buffer", &drawn.orbit_both_whole}})
            rows_.push_back({phantom, motion, *frames});
    }

    double median_ms(const std::string& phantom, const std::string& motion) const {
        const auto row = std::ranges::find_if(
            rows_, [&](const Row& one) { return one.phantom == phantom && one.motion == motion; });
        return percentile(row->frames.wall, 0.5);
    }

    void compare_eyes(ordered_json& found) const {
        for (const char* const phantom : {"tooth", "head"}) {
            const double one_ms = median_ms(phantom, "orbit");
            const double halves = median_ms(phantom, "orbit side by side") / one_ms;
            const double wholes = median_ms(phantom, "orbit quad buffer") / one_ms;
            say("{}: two eyes take {:.2f} times one eye's time side by side, {:.2f} times in a quad buffer, "
                "where "
                "each has all pixels (goal: below 1.7)",
                phantom, halves, wholes);
            found["two_eyes_to_one"][phantom] = {{"side_by_side", halves}, {"quad_buffer", wholes}};
        }
    }

    const FullRateOptions& options_;
    StudyRun run_;
    gl::OffscreenContext context_;
    std::string gl_renderer_;
    bool is_software_;
    glm::ivec2 size_px_;
    int frames_;
    std::vector<Row> rows_{};
};

}  // namespace

void measure_full_rate(const FullRateOptions& options, const StudySurroundings& surroundings) {
    FullRate(options, surroundings).run();
}

}  // namespace osteomill::study
