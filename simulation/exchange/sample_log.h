// A log to which a loop pushes samples. Its maker decides their use, such as lines of a file.
#pragma once

#include <vector>

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

/// A log whose samples go to several.
template <typename Sample>
class SampleLogs final : public SampleLog<Sample> {
  public:
    /// Before the loop runs. `log` outlives it; null does nothing.
    void add(SampleLog<Sample>* log) {
        if (log != nullptr) logs_.push_back(log);
    }

    void begin() override {
        for (SampleLog<Sample>* log : logs_) log->begin();
    }
    void push(const Sample& sample) noexcept override {
        for (SampleLog<Sample>* log : logs_) log->push(sample);
    }
    void drain() override {
        for (SampleLog<Sample>* log : logs_) log->drain();
    }
    void drain_all() override {
        for (SampleLog<Sample>* log : logs_) log->drain_all();
    }

  private:
    std::vector<SampleLog<Sample>*> logs_;
};

}  // namespace osteomill
