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
/// moved it. Each such fault does so by itself, whatever else is wrong (FaultSet). Every fault cancels the
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

/// All the faults of one tick. None hides another: each that matters by itself is asked for by itself, and
/// only people are told of one (first()).
class FaultSet {
  public:
    constexpr FaultSet() = default;
    /// The set of one fault; empty for Fault::none. Implicit: a fault is a set of one.
    constexpr FaultSet(Fault fault) noexcept : bits_(bit_of(fault)) {}

    constexpr void add(Fault fault) noexcept { bits_ = static_cast<Bits>(bits_ | bit_of(fault)); }
    constexpr bool has(Fault fault) const noexcept { return (bits_ & bit_of(fault)) != 0; }
    constexpr bool is_empty() const noexcept { return bits_ == 0; }

    /// The one that people learn of, by told_first; none if the set is empty.
    constexpr Fault first() const noexcept {
        for (const Fault fault : told_first)
            if (has(fault)) return fault;
        return Fault::none;
    }
    /// Whether any of them ends the permission of a pedal that is held.
    constexpr bool withdraws_pedal() const noexcept {
        for (const Fault fault : all_faults)
            if (has(fault) && osteomill::withdraws_pedal(fault)) return true;
        return false;
    }

    constexpr bool operator==(const FaultSet&) const = default;

  private:
    using Bits = std::uint16_t;
    static_assert(all_faults.size() <= 16);

    static constexpr Bits bit_of(Fault fault) noexcept {
        return fault == Fault::none ? Bits{0} : static_cast<Bits>(1U << (static_cast<unsigned>(fault) - 1U));
    }

    Bits bits_ = 0;
};

}  // namespace osteomill
