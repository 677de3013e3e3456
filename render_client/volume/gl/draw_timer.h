// A timer of the driver's work between two points (GL_TIME_ELAPSED): the time of the drawing, not of the
// call, which returns long before. It also measures a software rasteriser: the wall-clock time of its
// threads' work.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "render_client/volume/gl/name.h"

namespace osteomill {

/// A stopwatch for drawing. An interface, so that tests can make time up.
class Stopwatch {
  public:
    virtual ~Stopwatch() = default;
    /// Begins a measurement of drawing, on whatever device draws.
    virtual void start() = 0;
    /// Ends it.
    virtual void stop() = 0;
    /// Seconds of the last measurement, once, as soon as they are known; waits for nothing. Until they have
    /// been taken, start and stop must not be called.
    virtual std::optional<double> take_s() = 0;
};

}  // namespace osteomill

namespace osteomill::gl {

/// Construction and every call need a current OpenGL context.
class DrawTimer final : public Stopwatch {
  public:
    void start() override {
        glBeginQuery(GL_TIME_ELAPSED, query_);
        started_ = Clock::now();
    }
    void stop() override {
        glEndQuery(GL_TIME_ELAPSED);
        pending_ = true;
    }
    std::optional<double> take_s() override {
        if (!pending_) return std::nullopt;
        GLuint available = GL_FALSE;
        glGetQueryObjectuiv(query_, GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) return std::nullopt;
        GLuint64 elapsed_ns = 0;
        glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &elapsed_ns);
        pending_ = false;
        // Mesa 22.3's software rasteriser now and then counts from the machine's start.
        const double at_most_s = std::chrono::duration<double>(Clock::now() - started_).count();
        return std::min(1e-9 * static_cast<double>(elapsed_ns), at_most_s);
    }

  private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point started_;
    QueryName query_;
    bool pending_ = false;
};

}  // namespace osteomill::gl
