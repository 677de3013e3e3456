// Faults that turn the force off.
#pragma once

#include <array>
#include <cstdint>

namespace osteomill {

enum class Fault : std::uint8_t {
    none,
    device_lost,
    model_stalled,
    not_a_number,
    overrun,
    device_jumped,
    in_bone,
    energy_to_hand,
    paused  ///< no failure: requested by a client
};

inline constexpr std::array all_faults{Fault::device_lost,    Fault::model_stalled, Fault::not_a_number,
                                       Fault::overrun,        Fault::device_jumped, Fault::in_bone,
                                       Fault::energy_to_hand, Fault::paused};

/// In the order in which people learn of them, if there are several. Nothing else depends on it.
inline constexpr std::array told_first{Fault::device_lost,  Fault::device_jumped,  Fault::model_stalled,
                                       Fault::not_a_number, Fault::energy_to_hand, Fault::paused,
                                       Fault::overrun,      Fault::in_bone};
static_assert(told_first.size() == all_faults.size());

/// Whether the fault cancels a pedal's permission for as long as it lasts, even if the pedal is pressed
/// meanwhile. The burr would otherwise turn in other bone than the bone of the press, or where no hand had
/// moved it. Each such fault does so by itself, whatever else is wrong (fault_set.h). Every fault cancels the
/// permission as it begins (safety_monitor.h).
constexpr bool withdraws_pedal(Fault fault) noexcept {
    switch (fault) {
        case Fault::device_lost:
        case Fault::device_jumped:
        case Fault::energy_to_hand:
        case Fault::paused:
            return true;
        case Fault::none:
        case Fault::model_stalled:
        case Fault::not_a_number:
        case Fault::overrun:
        case Fault::in_bone:
            return false;
    }
    return true;
}

/// One line for people; empty for Fault::none.
const char* describe(Fault fault) noexcept;

/// Its name for programs, in --json and --metrics. The names stay as they are.
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
