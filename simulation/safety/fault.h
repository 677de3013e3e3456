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

/// One line for people; empty for Fault::none.
const char* describe(Fault fault) noexcept;

}  // namespace osteomill
