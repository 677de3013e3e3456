#include "render_client/ui/film_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>

#include "common/program/progress.h"
#include "render_client/ui/offscreen_run.h"
#include "render_client/ui/view/film_file.h"
#include "render_client/ui/view/picture_options.h"
#include "render_client/ui/view/recording_camera.h"
#include "render_client/ui/view/session_picture.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

constexpr int frames_per_s = 30;

/// Reads up to the wanted time of the recording.
void arrive(SessionPicture& session, const RecordingPlayer& player) {
    do {
        session.take_in();
        if (!session.bone_problem().empty()) throw std::runtime_error(session.bone_problem());
    } while (!player.has_arrived() && player.error().empty());
}

}  // namespace

RenderReport run_film(const RenderOptions& options, SessionSource& source,
                      const std::function<bool()>& stop_requested) {
    RecordingPlayer& player = *source.player();
    player.pause();
    const gl::OffscreenContext context(options.gpu);
    gl::require_opengl_3_3();
    ImguiContext panels;
    RecordingCamera camera(options, &player, player.has_view() ? "trainee" : "");
    const glm::ivec2 size_px =
        options.window_size_px.value_or(camera.size_px().value_or(default_offscreen_size_px));
    SessionPicture session(source, panels, size_px, FrameQuality::full, options.renderer, options.look,
                           options.stereo);
    take_over(session, options);
    session.view().playback_shown = false;
    session.view().scale = static_cast<float>(options.ui_scale.value_or(1.0));

    FilmFile film(*options.film, session.size_px(), frames_per_s);
    FrameTimes frame_times;
    ProgressLine progress(std::cerr, ::isatty(STDERR_FILENO) == 1, "film");
    const double begins_s = player.time_s();
    const double lasts_s = player.duration_s() - begins_s;
    const double frame_s = options.speed / frames_per_s;
    for (int frame = 0; frame * frame_s <= lasts_s; ++frame) {
        if (stop_requested()) throw std::runtime_error("interrupted; no film was written");
        const auto start = std::chrono::steady_clock::now();
        player.seek(begins_s + frame * frame_s);
        arrive(session, player);
        camera.aim(session);
        film.add(session.draw(1.0 / frames_per_s).read_back());
        frame_times.add(1e3 *
                        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        if (!player.error().empty()) break;
        progress.report(std::min(1.0, (frame + 1) * frame_s / std::max(lasts_s, frame_s)));
    }
    film.close();
    RenderReport report = session.report();
    report.frame_times = std::move(frame_times);
    return report;
}

}  // namespace osteomill
