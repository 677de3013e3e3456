#include "render_client/dataset/dataset_run.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "render_client/dataset/dataset_index.h"
#include "render_client/dataset/image_files.h"
#include "render_client/dataset/random_look.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

/// From a time on every state, or the first at or behind the beginning of each period.
class Schedule {
  public:
    Schedule(double from_s, std::optional<double> frames_per_s)
        : from_s_(from_s), frames_per_s_(frames_per_s) {}
    bool is_due(double time_s) {
        if (time_s < from_s_) return false;
        if (!frames_per_s_) return true;
        // On the virtual clock a state lies on a period's beginning, but for rounding.
        const double period = std::floor(time_s * *frames_per_s_ + 1e-6);
        return period > std::exchange(period_, std::max(period_, period));
    }

  private:
    double from_s_;
    std::optional<double> frames_per_s_;
    double period_ = -std::numeric_limits<double>::infinity();
};

class DatasetRun {
  public:
    DatasetRun(const RenderOptions& options, const std::string& version)
        : recording_(*options.replay),
          from_s_(options.from_s),
          options_(*options.dataset),
          cameras_(options_.cameras.empty() ? default_cameras() : read_cameras(options_.cameras)),
          look_{.ambient_occlusion = options.ambient_occlusion,
                .specular = static_cast<float>(options.specular)},
          limits_{.budget_bytes = options.texture_budget_bytes},
          playhead_(recording_),
          context_(options.gpu),
          index_(recording_, version, cameras_, options_),
          schedule_(from_s_, options_.frames_per_s) {
        gl::require_opengl_3_3();
        for (const DatasetCamera& camera : cameras_)
            std::filesystem::create_directories(options_.folder / camera.name);
        begin_session();
    }

    RenderReport run(const std::function<bool()>& stop_asked) {
        try {
            take_frames(stop_asked);
        } catch (const RecordingError&) {
            if (frames_ > 0) index_.write();  // of what could be read
            throw;
        }
        if (frames_ == 0)
            throw std::runtime_error(
                fmt::format("{}: holds no state from {} s on", recording_.string(), from_s_));
        index_.write();
        RenderReport report;
        report.frame_times = frame_times_;
        report.gl_renderer = gl::renderer_name();
        report.bone_checksum = playhead_.bone_checksum();
        report.textures = images_->textures().plan();
        return report;
    }

  private:
    void take_frames(const std::function<bool()>& stop_asked) {
        while (!stop_asked()) {
            const Playhead::Step step = playhead_.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::end) return;
            if (step == Playhead::Step::new_bone) begin_session();
            if (step == Playhead::Step::state && !has_more_of_this_instant() &&
                schedule_.is_due(playhead_.time_s()))
                take_frame();
        }
    }

    void begin_session() {
        images_.emplace(playhead_, cameras_, look_, limits_);
        index_.begin_session(playhead_.session(), playhead_.bone().grid());
        colours_rgb_ = colours_of(label_table(playhead_.session().tissues));
    }

    /// The changes of one instant may come in several states.
    bool has_more_of_this_instant() const {
        const StateArrived* next = playhead_.next_state();
        return next != nullptr && next->state.tool.time_s == playhead_.tool()->time_s &&
               playhead_.next_time_s() == playhead_.time_s();
    }

    void take_frame() {
        const Clock::time_point start = Clock::now();
        const std::size_t frame = frames_++;
        images_->follow();
        if (!options_.part.has(frame)) return;
        const bool wants_surface = options_.randomise || options_.images.depth || options_.images.ray_depth ||
                                   options_.images.labels || options_.images.normals;
        nlohmann::ordered_json files = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            CameraImages images = images_->draw(i, options_.images.colour, wants_surface);
            nlohmann::ordered_json look;
            if (options_.randomise && options_.images.colour) {
                const RandomLook drawn = random_look(*options_.randomise, frame, i, colours_rgb_.size());
                images.colour = looked_at(images, cameras_[i].pinhole, drawn);
                look = json_of(drawn);
            }
            files.push_back(write_images(options_, frame, cameras_[i], images, colours_rgb_));
            if (!look.is_null()) files.back()["look"] = std::move(look);
        }
        index_.add_frame(frame, playhead_, std::move(files));
        frame_times_.add(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }

    const std::filesystem::path recording_;
    const double from_s_;
    const DatasetOptions options_;
    const std::vector<DatasetCamera> cameras_;
    const SceneAppearance look_;
    const TextureLimits limits_;
    Playhead playhead_;
    gl::OffscreenContext context_;
    DatasetIndex index_;
    Schedule schedule_;
    std::optional<SessionImages> images_;
    std::vector<std::array<std::uint8_t, 3>> colours_rgb_;
    std::size_t frames_ = 0;  ///< of all parts
    FrameTimes frame_times_;
};

}  // namespace

RenderReport run_dataset(const RenderOptions& options, const std::string& version,
                         const std::function<bool()>& stop_asked) {
    return DatasetRun(options, version).run(stop_asked);
}

}  // namespace osteomill
