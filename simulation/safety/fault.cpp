#include "simulation/safety/fault.h"

namespace osteomill {

const char* describe(Fault fault) noexcept {
    switch (fault) {
        case Fault::none:
            return "";
        case Fault::device_lost:
            return "the haptic device does not answer: force off";
        case Fault::model_stalled:
            return "the milling model is late: force off";
        case Fault::not_a_number:
            return "the force is not a number: force off";
        case Fault::overrun:
            return "the haptic loop misses its deadlines: force off";
        case Fault::device_jumped:
            return "the device jumped: force off";
        case Fault::in_bone:
            return "the burr is inside the bone: no force until it is held clear of it";
        case Fault::energy_to_hand:
            return "the force pushed the hand with more energy than bone has: force and spindle off";
        case Fault::paused:
            return "paused: force and spindle off";
    }
    return "unknown fault: force off";
}

}  // namespace osteomill
