#include "studies/render/full_rate/window_frames.h"

#include <stdexcept>

#include "render_client/ui/view/session_picture.h"
#include "render_client/volume/picture.h"
#include "studies/render/phantom_session.h"

namespace osteomill::study {

namespace {

constexpr double frame_s = 1.0 / 30.0;
constexpr double orbit_rad_a_frame = 0.03;

/// A window without a display, and its frames.
class Window {
  public:
    Window(PhantomSession& session, const glm::ivec2& size_px, StereoLayout layout)
        : session_(session),
          picture_(session, panels_, size_px, FrameQuality::full, RendererChoice::raycast, {},
                   {.layout = layout}) {
        picture_.take_in();
        if (!picture_.has_bone()) throw std::runtime_error(picture_.bone_problem());
        first_view_ = picture_.camera();
        // Compiles shaders and draws all of it: not measured.
        for (int frame = 0; frame < 2; ++frame) draw();
    }

    FrameMilliseconds orbited(int frames) {
        FrameStopwatch stopwatch;
        for (int frame = 0; frame < frames; ++frame) {
            session_.step();
            orbit(picture_.camera(), orbit_rad_a_frame, 0.0);
            stopwatch.time([&] { draw(); });
        }
        return stopwatch.frames();
    }
    FrameMilliseconds carved(int frames) {
        picture_.camera() = first_view_;
        draw();
        session_.mill(true);
        FrameStopwatch stopwatch;
        for (int frame = 0; frame < frames; ++frame) {
            session_.step();
            stopwatch.time([&] { draw(); });
        }
        session_.mill(false);
        return stopwatch.frames();
    }
    Picture picture() { return picture_.draw(frame_s).read_back(); }

  private:
    void draw() {
        picture_.take_in();
        // A pixel that is read has been drawn, and all others with it.
        picture_.draw(frame_s).depth_at({0, 0});
    }

    ImguiContext panels_;
    PhantomSession& session_;
    SessionPicture picture_;
    Camera first_view_;
};

}  // namespace

WindowFrames draw_window(const std::string& phantom, const glm::ivec2& size_px, int frames,
                         const std::filesystem::path& picture) {
    WindowFrames drawn;
    PhantomSession session(phantom);
    for (const auto& [layout, orbit] : {std::pair{StereoLayout::side_by_side, &drawn.orbit_side_by_side},
                                        std::pair{StereoLayout::quad_buffer, &drawn.orbit_both_whole}}) {
        session.begin_anew();
        *orbit = Window(session, size_px, layout).orbited(frames);
    }
    session.begin_anew();
    Window window(session, size_px, StereoLayout::off);
    drawn.orbit = window.orbited(frames);
    write_png(window.picture(), picture);
    drawn.carve = window.carved(frames);
    return drawn;
}

}  // namespace osteomill::study
