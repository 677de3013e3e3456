// Some of a scene's fixtures, as a number: bit i is the i-th.
#pragma once

#include <cstddef>
#include <cstdint>

namespace osteomill {

using FixtureSet = std::uint32_t;

inline constexpr std::size_t most_fixtures = 16;  ///< of a scene
inline constexpr FixtureSet every_fixture = (FixtureSet{1} << most_fixtures) - 1;

constexpr FixtureSet fixture_bit(std::size_t number) {
    return FixtureSet{1} << number;
}
constexpr bool has_fixture(FixtureSet set, std::size_t number) {
    return (set & fixture_bit(number)) != 0;
}

}  // namespace osteomill
