// Session time, and how to wait for it: a real clock for a hand, a virtual one for tests and studies.
#pragma once

#include <atomic>

namespace osteomill {

/// Seconds since the session began. Real-time safe.
class Clock {
  public:
    virtual ~Clock() = default;
    virtual double now_s() const noexcept = 0;
    /// Returns at `time_s` or as soon after as it can; at once if that has passed.
    virtual void sleep_until(double time_s) noexcept = 0;
};

/// CLOCK_MONOTONIC from construction on. Sleeps to an absolute time and spins the last stretch, which the
/// kernel's wake-up would otherwise overshoot. Any thread.
class RealClock final : public Clock {
  public:
    static constexpr double spin_s = 30e-6;

    RealClock() noexcept;
    double now_s() const noexcept override;
    void sleep_until(double time_s) noexcept override;

  private:
    double began_s_;
};

/// Goes on only when someone sleeps, and then at once. One thread.
class VirtualClock final : public Clock {
  public:
    double now_s() const noexcept override { return now_s_; }
    void sleep_until(double time_s) noexcept override {
        if (time_s > now_s_) now_s_ = time_s;
    }

  private:
    double now_s_ = 0.0;
};

}  // namespace osteomill
