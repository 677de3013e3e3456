// All the faults of one tick. None hides another: each that matters by itself is asked for by itself, and
// only people are told of one (first()).
#pragma once

#include <cstdint>

#include "simulation/safety/fault.h"

namespace osteomill {

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
