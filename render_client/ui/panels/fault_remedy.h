// The remedy for a fault that the server reports, told to the trainee in English; tr() translates it.
#pragma once

#include <array>
#include <string_view>

namespace osteomill {

struct FaultRemedy {
    std::string_view fault;  ///< as the server words it (simulation/safety/fault.cpp)
    const char* remedy;
};

inline constexpr std::array<FaultRemedy, 7> fault_remedies{
    {{"the haptic device does not answer: force off",
      "Let go of the handle, and see whether the arm has power and its cable is in. The force comes back by "
      "itself."},
     {"the milling model is late: force off",
      "Lift the burr out of the bone and wait a moment: the force comes back by itself. If it happens again, "
      "close other "
      "programs on the server's machine."},
     {"the force is not a number: force off",
      "Lift the burr out of the bone. If it happens again, finish the session and tell whoever looks after "
      "the simulator."},
     {"the haptic loop misses its deadlines: force off",
      "Wait a moment: the force comes back by itself. If it happens again, close other programs on the "
      "server's machine."},
     {"the device jumped: force off", "Hold the handle still, lift the pedal, and press it again."},
     {"the burr is inside the bone: no force until it is held clear of it",
      "Pull the burr back along its shaft, until it is clear of the bone."},
     {"the force pushed the hand with more energy than bone has: force and spindle off",
      "Pull the burr back, lift the pedal, and press it again."}}};

/// The fault's remedy; for a fault that this program does not know, a remedy that is right for any.
constexpr const char* remedy_of(std::string_view fault) {
    for (const FaultRemedy& known : fault_remedies)
        if (known.fault == fault) return known.remedy;
    return "Lift the burr out of the bone, and the pedal. If it stays, finish the session: all is saved.";
}

}  // namespace osteomill
