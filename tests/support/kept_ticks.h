// Ticks of a session, kept in memory.
#pragma once

#include <vector>

#include "common/session/tick_sample.h"
#include "simulation/exchange/sample_log.h"

namespace osteomill::testing {

class KeptTicks final : public SampleLog<TickSample> {
  public:
    void push(const TickSample& sample) noexcept override { samples.push_back(sample); }
    void drain() override {}
    void drain_all() override {}
    std::vector<TickSample> samples;
};

}  // namespace osteomill::testing
