// A log to which a loop pushes samples. Its maker decides their use, such as lines of a file.
#pragma once

namespace osteomill {

template <typename Sample>
class SampleLog {
  public:
    virtual ~SampleLog() = default;

    /// At time zero of a session on the real clock, before its first push.
    virtual void begin() {}

    /// From one loop only. Real-time safe.
    virtual void push(const Sample& sample) noexcept = 0;

    // From one other thread.

    /// Hands on the pushed samples, unless it would have to wait.
    virtual void drain() = 0;
    /// Drains however long it takes: for sessions that run on a clock of their own.
    virtual void drain_all() = 0;
};

}  // namespace osteomill
