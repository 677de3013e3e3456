// Session time on the real clock, and how to wait for it. The virtual clock needs neither: see
// MillingSession.
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

/// CLOCK_BOOTTIME from construction on: a machine that was asleep finds that time has passed. Sleeps to an
/// absolute time and spins the last stretch, which the kernel's wake-up would otherwise overshoot. Any
/// thread.
///
/// Time never goes back. If the system's clock is set back (a program that was moved to another machine, a
/// clock that somebody forges), it goes on from the latest time that was read: otherwise a loop would wait
/// until that time came again.
class RealClock final : public Clock {
  public:
    static constexpr double spin_s = 30e-6;
    /// Less is another thread that has read the clock meanwhile.
    static constexpr double least_step_back_s = 1e-3;

    /// `system_s`: seconds, of a clock that advances like the system's. Real-time safe.
    explicit RealClock(double (*system_s)() noexcept = boot_time_s) noexcept;
    double now_s() const noexcept override;
    void sleep_until(double time_s) noexcept override;

    static double boot_time_s() noexcept;

  private:
    double (*system_s_)() noexcept;
    mutable std::atomic<double> began_s_;        // on the system's clock
    mutable std::atomic<double> latest_s_{0.0};  // that was read
};

}  // namespace osteomill
