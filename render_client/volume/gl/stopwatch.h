// A stopwatch for drawing. An interface, so that tests can make time up.
#pragma once

#include <optional>

namespace osteomill {

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
