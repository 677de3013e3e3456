// Names of faults for programs, in --json and --metrics. They stay as they are.
#pragma once

#include "simulation/safety/fault.h"

namespace osteomill {

constexpr const char* name_of(Fault fault) noexcept {
    switch (fault) {
        case Fault::none:
            return "none";
        case Fault::device_lost:
            return "device_lost";
        case Fault::model_stalled:
            return "model_stalled";
        case Fault::not_a_number:
            return "not_a_number";
        case Fault::overrun:
            return "overrun";
        case Fault::device_jumped:
            return "device_jumped";
        case Fault::in_bone:
            return "in_bone";
        case Fault::energy_to_hand:
            return "energy_to_hand";
        case Fault::paused:
            return "paused";
    }
    return "unknown";
}

}  // namespace osteomill
