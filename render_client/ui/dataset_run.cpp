#include "render_client/ui/dataset_run.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "render_client/dataset/dataset_index.h"
#include "render_client/dataset/image_files.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

DatasetContents contents_of(const RenderOptions& options) {
    const DatasetOptions& dataset = *options.dataset;
    return {.cameras = cameras_named(dataset.cameras),
            .from_s = options.from_s,
            .frames_per_s = dataset.frames_per_s,
            .images = dataset.images,
            .part = dataset.part,
            .randomise = dataset.randomise,
            .look = {.ambient_occlusion = options.ambient_occlusion,
                     .thin_bone = options.thin_bone,
                     .smooth_silhouettes = options.smooth_silhouettes.value_or(false),
                     .specular = options.specular ? static_cast<float>(*options.specular)
                                                  : usual_look(dataset.randomise.has_value()).specular,
                     .grain = options.grain,
                     .neutral_sawn_faces = options.neutral_sawn_faces},
            .limits = {.budget_bytes = options.texture_budget_bytes}};
}

nlohmann::ordered_json written(const std::filesystem::path& folder, const DatasetFrame& frame,
                               const DatasetFrames& frames) {
    const DatasetContents& contents = frames.contents();
    const auto colours_rgb = colours_of(label_table(frames.playhead().session().tissues));
    nlohmann::ordered_json images = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < frame.images.size(); ++i) {
        const DatasetCamera& camera = contents.cameras[i];
        images.push_back(view_json(frame, i, camera));
        images.back().update(
            write_images(folder, contents.images, frame.number, camera.name, frame.images[i], colours_rgb));
    }
    return images;
}

}  // namespace

RenderReport run_dataset(const RenderOptions& options, const std::string& version,
                         const std::function<bool()>& stop_requested) {
    const std::filesystem::path& recording = *options.replay;
    const std::filesystem::path& folder = options.dataset->folder;
    const DatasetContents contents = contents_of(options);
    const gl::OffscreenContext context(options.gpu);
    gl::require_opengl_3_3();
    DatasetIndex index(folder, recording.filename().string(), version, contents);
    DatasetFrames frames(recording, contents,
                         [&](const ImagedSession& session) { index.begin_session(session); });
    for (const DatasetCamera& camera : contents.cameras)
        std::filesystem::create_directories(folder / camera.name);
    RenderReport report;
    try {
        for (;;) {
            const Clock::time_point start = Clock::now();
            const auto frame = frames.next(stop_requested);
            if (!frame) break;
            index.add_frame(*frame, frames.session(), written(folder, *frame, frames));
            report.frame_times.add(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        }
    } catch (const RecordingError&) {
        if (frames.count() > 0) index.write();  // with the frames that could be read
        throw;
    }
    if (frames.count() == 0)
        throw std::runtime_error(
            fmt::format("{}: holds no state from {} s on", recording.string(), options.from_s));
    index.write();
    report.gl_renderer = gl::renderer_name();
    report.bone_checksum = frames.playhead().bone_checksum();
    report.textures = frames.textures().plan();
    return report;
}

}  // namespace osteomill
