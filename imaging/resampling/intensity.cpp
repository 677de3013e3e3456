#include "imaging/resampling/intensity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/text/words.h"

namespace osteomill {

namespace {

std::array<double, 2> two_numbers(const char* option, const char* form, const std::string& text) {
    const auto numbers = listed_numbers<2>(text);
    if (!numbers)
        throw std::invalid_argument(fmt::format("{} '{}': it is {}, two numbers", option, text, form));
    return *numbers;
}

}  // namespace

Rescale parse_rescale(const std::string& text) {
    const auto [slope, intercept] = two_numbers("--rescale", "SLOPE,INTERCEPT", text);
    constexpr double most = 1e6;
    if (!(std::abs(slope) <= most && std::abs(intercept) <= most))
        throw std::invalid_argument(
            fmt::format("--rescale '{}': slope and intercept lie within {:.0f}", text, most));
    if (slope == 0.0) throw std::invalid_argument("--rescale '" + text + "': the slope may not be 0");
    return {.slope = slope, .intercept = intercept};
}

IntensityWindow parse_intensity_window(const std::string& text) {
    const auto [low, high] = two_numbers("--intensity-window", "LOW,HIGH", text);
    if (!(low < high))
        throw std::invalid_argument("--intensity-window '" + text + "': LOW must be below HIGH");
    return {.low = low, .high = high};
}

void rescale_values(const Rescale& rescale, std::span<float> values) {
    for (float& value : values) value = static_cast<float>(rescale.slope * value + rescale.intercept);
}

void window_values(const IntensityWindow& window, std::span<float> values) {
    const double hu_per_step = window_top_hu / (window.high - window.low);
    for (float& value : values)
        value = std::isnan(value)
                    ? value
                    : static_cast<float>(std::clamp((value - window.low) * hu_per_step, 0.0, window_top_hu));
}

std::size_t mark_not_finite(std::span<float> values) {
    std::size_t count = 0;
    for (float& value : values) {
        if (std::isfinite(value)) continue;
        value = std::numeric_limits<float>::quiet_NaN();
        ++count;
    }
    return count;
}

}  // namespace osteomill
