// Times of frames that were finished: each drawn to its last pixel before the next began, as showing it
// needs.
#pragma once

#include <functional>
#include <vector>

#include "render_client/volume/gl/draw_timer.h"

namespace osteomill::study {

/// By frame, in order.
struct FrameMilliseconds {
    std::vector<double> wall{};  ///< until the picture was there
    std::vector<double>
        gpu{};  ///< the driver's own work (GL_TIME_ELAPSED); for a software rasteriser, wall time
    std::vector<double> cpu{};  ///< all threads of the process
};

class FrameStopwatch {
  public:
    /// Needs a current OpenGL context, in which nothing else measures GL_TIME_ELAPSED.
    FrameStopwatch() = default;
    /// `work` draws one frame and returns when its pixels are there.
    void time(const std::function<void()>& work);
    const FrameMilliseconds& frames() const { return frames_; }

  private:
    gl::DrawTimer timer_;
    FrameMilliseconds frames_;
};

}  // namespace osteomill::study
