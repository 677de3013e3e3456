#include "common/session/decimal_code.h"

#include <array>
#include <cmath>

namespace osteomill {

namespace {

constexpr std::array powers_of_ten{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

}  // namespace

std::int64_t to_code(double value, int decimals) {
    const double magnitude = std::abs(value);
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    double whole = std::floor(magnitude * scale);
    // The sign is that of the exact value, although the product was rounded.
    const double beyond_half = std::fma(magnitude, scale, -(whole + 0.5));
    if (beyond_half > 0.0 || (beyond_half == 0.0 && std::fmod(whole, 2.0) == 1.0)) whole += 1.0;
    if (!(whole < largest_decimal_code)) whole = largest_decimal_code;
    const auto code = static_cast<std::int64_t>(whole);
    return std::signbit(value) ? ~code : code;
}

double from_code(std::int64_t code, int decimals) {
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    return code < 0 ? -(static_cast<double>(~code) / scale) : static_cast<double>(code) / scale;
}

}  // namespace osteomill
