// A coupling that returns the test's values, to test the code around a coupling.
#pragma once

#include "simulation/coupling/coupling.h"

namespace osteomill::testing {

struct Script {
    CouplingOutput says;
    int resets = 0;
};

class ScriptedCoupling final : public Coupling {
  public:
    explicit ScriptedCoupling(Script& script) : script_(script) {}

    CouplingOutput tick(const HandState&, const MillingResult&) noexcept override { return script_.says; }
    void reset() noexcept override { ++script_.resets; }
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<ScriptedCoupling>(*this); }

  private:
    Script& script_;
};

}  // namespace osteomill::testing
