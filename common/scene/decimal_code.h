// Numbers with a fixed number of decimals as whole numbers of the last one, as logs round and recordings pack
// them.
#pragma once

#include <cstdint>

namespace osteomill {

/// Codes up to here, and what lies between two of them, are exact in a double.
inline constexpr double largest_decimal_code = 1e15;

/// The whole number of a value's last decimal, of 0 to 9: rounded as fmt::format rounds it, half to even.
/// Minus zero is a number of its own, -1, and -1 is -2, for a log tells it from zero. Values beyond 1e15, and
/// NaN, become 1e15.
std::int64_t to_code(double value, int decimals);
double from_code(std::int64_t code, int decimals);

}  // namespace osteomill
