// Numbers with a fixed number of decimals as whole numbers of the last one, as logs round and recordings pack
// them.
#pragma once

#include <cstdint>

namespace osteomill {

/// Codes up to here, and the differences of two of them, are exact in a double.
inline constexpr double largest_decimal_code = 1e15;

/// The whole number of a value's last decimal, of 0 to 9: rounded as fmt::format rounds it, half to even.
/// Minus zero has a code of its own, -1, since a log tells it from zero; -1 has the code -2. Values beyond
/// 1e15, and NaN, become 1e15.
std::int64_t to_code(double value, int decimals);
double from_code(std::int64_t code, int decimals);

}  // namespace osteomill
