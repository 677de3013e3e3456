// A stopwatch for drawing. An interface, so that tests can make time up.
#pragma once

#include <optional>

namespace osteomill {

class Stopwatch {
  public:
    virtual ~Stopwatch() = default;
    /// What is drawn from here ...
    virtual void start() = 0;
    /// ... to here is measured, on whatever draws it.
    virtual void stop() = 0;
    /// Seconds of the last measurement, once, as soon as they are known; waits for nothing. Until they have
    /// been taken, start and stop must not be called.
    virtual std::optional<double> take_s() = 0;
};

}  // namespace osteomill
