// Wake-up of a thread that waits for work, from a loop that must not wait.
#pragma once

namespace osteomill {

class WakeUp {
  public:
    /// Throws std::system_error if the system has no more of them.
    WakeUp();
    ~WakeUp();
    WakeUp(const WakeUp&) = delete;
    WakeUp& operator=(const WakeUp&) = delete;

    /// Ends a wait() of another thread, or its next. Real-time safe: one call of the system that never waits.
    void wake() noexcept;

    /// Until wake(), `longest_ms` at most.
    void wait(int longest_ms) noexcept;

    /// Readable once awake, for a thread that waits for more than this.
    int descriptor() const { return event_; }

  private:
    int event_ = -1;  // an eventfd
};

}  // namespace osteomill
