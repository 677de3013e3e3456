// A log to which a loop pushes samples. Its maker decides their use, such as lines of a file.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
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

/// A log that keeps samples in bounded memory until another thread takes them.
template <typename Sample>
class SampleQueue final : public SampleLog<Sample> {
  public:
    explicit SampleQueue(std::size_t capacity = Sample::capacity) : queue_(capacity) {}

    /// One loop only. When the queue is full the sample is dropped and counted. Real-time safe.
    void push(const Sample& sample) noexcept override {
        if (!queue_.push(sample)) dropped_.fetch_add(1, std::memory_order_relaxed);
    }
    /// Any one other thread.
    template <typename Take>
    void consume_all(Take&& take) {
        queue_.consume_all(take);
    }
    bool empty() const { return queue_.read_available() == 0; }
    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

    /// Nothing: the reader takes the samples in its own time.
    void drain() override {}
    void drain_all() override {}

  private:
    boost::lockfree::spsc_queue<Sample> queue_;
    std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace osteomill
