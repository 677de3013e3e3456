// A log whose samples go to several.
#pragma once

#include <vector>

#include "simulation/exchange/sample_log.h"

namespace osteomill {

template <typename Sample>
class SampleTee final : public SampleLog<Sample> {
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
