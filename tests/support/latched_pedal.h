// A device's pedal as the loop takes it: the latch of safety/pedal_latch.h on a device that a test reads by
// itself.
#pragma once

#include "simulation/safety/pedal_latch.h"

namespace osteomill::testing {

class LatchedPedal {
  public:
    /// Once for each reading. Whether the spindle would turn.
    bool reads(const DeviceState& state, double now_s) {
        latch_.tick(date_.look(state.pedal, now_s), !state.connected);
        return latch_.is_pressed();
    }

  private:
    PedalDate date_;
    PedalLatch latch_;
};

}  // namespace osteomill::testing
