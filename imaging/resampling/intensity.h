// From the numbers of a file to HU, if the file itself does not say.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace osteomill {

/// HU = slope * value + intercept.
struct Rescale {
    double slope = 1.0;
    double intercept = 0.0;
};

/// For images without HU (MRI, 8-bit scans): `low` becomes 0 HU (soft tissue), `high` 2000 HU (dense bone),
/// linear between, clamped outside.
struct IntensityWindow {
    double low = 0.0;
    double high = 0.0;
};

inline constexpr double window_top_hu = 2000.0;

/// "SLOPE,INTERCEPT" and "LOW,HIGH". Throw std::invalid_argument unless two finite numbers; slope may not be
/// 0, LOW must be below HIGH.
Rescale parse_rescale(const std::string& text);
IntensityWindow parse_intensity_window(const std::string& text);

void rescale_values(const Rescale& rescale, std::span<float> values);
void window_values(const IntensityWindow& window, std::span<float> values);

/// Turns infinite values into not-a-number, too: neither was measured. How many there are.
std::size_t mark_not_finite(std::span<float> values);

}  // namespace osteomill
