// A log that keeps samples in bounded memory until another thread takes them.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "simulation/exchange/sample_log.h"

namespace osteomill {

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
