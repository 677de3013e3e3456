// Session time on the real clock, and how to wait for it. The virtual clock needs neither: see
// MillingSession.
#pragma once

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

}  // namespace osteomill
