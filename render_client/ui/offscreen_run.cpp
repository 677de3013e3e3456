#include "render_client/ui/offscreen_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/log/log.h"
#include "render_client/sound/session_sound.h"
#include "render_client/ui/view/picture_export.h"
#include "render_client/ui/view/picture_options.h"
#include "render_client/ui/view/recording_camera.h"
#include "render_client/ui/view/redraw.h"
#include "render_client/ui/view/session_picture.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto frame_period =
    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / 30.0));
constexpr double silent_wait_for_bone_s = 1.0;
constexpr double said_again_after_s = 10.0;

double seconds(Clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

/// Polls until the first bone is there. False if the run was asked to stop before.
bool wait_for_bone(SessionPicture& session, const std::function<bool()>& stop_requested) {
    const Clock::time_point start = Clock::now();
    double says_at_s = silent_wait_for_bone_s;
    while (!stop_requested()) {
        session.take_in();
        if (const double waited_s = seconds(Clock::now() - start); waited_s > says_at_s) {
            log_info("waiting for a bone, {:.0f} of at most {:.0f} s: {}", waited_s, longest_wait_for_bone_s,
                     session.link().status_line);
            says_at_s += said_again_after_s;
        }
        if (session.has_bone()) return true;
        if (!session.bone_problem().empty()) throw std::runtime_error(session.bone_problem());
        const LinkStatus status = session.link().status;
        if (status == LinkStatus::refused || status == LinkStatus::finished)
            throw std::runtime_error("no bone to draw: " + session.link().status_line);
        if (seconds(Clock::now() - start) > longest_wait_for_bone_s)
            throw std::runtime_error(fmt::format("no bone after {:.0f} s: {}", longest_wait_for_bone_s,
                                                 session.link().status_line));
        std::this_thread::sleep_for(frame_period);
    }
    return false;
}

}  // namespace

RenderReport run_offscreen(const RenderOptions& options, SessionSource& source,
                           const std::function<bool()>& stop_requested) {
    Screenshots screenshots(options.screenshots, screenshot_interval(options));
    const gl::OffscreenContext context(options.gpu);
    gl::require_opengl_3_3();
    ImguiContext panels;
    SessionPicture session(source, panels, options.window_size_px.value_or(default_offscreen_size_px),
                           FrameQuality::full, options.renderer, options.look, options.stereo);
    take_over(session, options);
    session.view().scale = static_cast<float>(options.ui_scale.value_or(1.0));
    RecordingCamera camera(options, source.player());
    SessionSound sound;
    if (options.sound) sound.switch_to(true);
    FrameTimes frame_times;

    bool going_on = wait_for_bone(session, stop_requested);
    Redraw redraw;
    redraw.note_change(Clock::now());
    const gl::Framebuffer* framebuffer = nullptr;  // the last frame that was drawn
    Clock::time_point drawn = Clock::now() - frame_period;
    Clock::time_point due = Clock::now();
    for (int frame = 1; going_on; ++frame) {
        const Clock::time_point start = Clock::now();
        const SessionNews news = session.take_in();
        sound.hear(session.tool(), session.session(), session.link().distances,
                   options.sound && session.view().warns);
        if (news == SessionNews::change) redraw.note_change(start);
        if (news == SessionNews::figures) redraw.note_figures();
        const LinkStatus status = session.link().status;
        going_on = frame < options.frames && status != LinkStatus::finished &&
                   status != LinkStatus::refused && !stop_requested();

        // A screenshot shows the newest figures, too.
        const bool is_written = !going_on || screenshots.is_next_due();
        if (framebuffer == nullptr || redraw.is_due(start) || (is_written && news != SessionNews::none)) {
            camera.aim(session);
            framebuffer = &session.draw(seconds(start - drawn));
            drawn = start;
            // Reading a pixel waits until the frame is finished, as showing it would.
            framebuffer->depth_at({0, 0});
            const Clock::duration took = Clock::now() - start;
            redraw.drew(start, took);
            frame_times.add(1e3 * seconds(took));
        }
        screenshots.after_frame(*framebuffer);
        if (!going_on) screenshots.after_last_frame(*framebuffer);
        due = std::max(due + frame_period, Clock::now());
        if (going_on) std::this_thread::sleep_until(due);
    }
    RenderReport report = session.report();
    report.frame_times = std::move(frame_times);
    return report;
}

}  // namespace osteomill
