// The strongest note of a sound, and how loud a sound is.
#pragma once

#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace osteomill::testing {

/// Frequency of the largest bin of the spectrum through a Hann window, Hz; bins are rate / count apart or
/// less.
inline double strongest_hz(std::span<const float> samples, double rate_hz) {
    std::vector<double> windowed;
    const auto count = static_cast<double>(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double window = 1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / count);
        windowed.push_back(window * static_cast<double>(samples[i]));
    }
    windowed.resize(std::bit_ceil(windowed.size()));  // other lengths take long
    std::vector<std::complex<double>> spectrum;
    Eigen::FFT<double>().fwd(spectrum, windowed);
    std::size_t strongest = 1;
    for (std::size_t bin = 2; bin < spectrum.size() / 2; ++bin)
        if (std::abs(spectrum[bin]) > std::abs(spectrum[strongest])) strongest = bin;
    return static_cast<double>(strongest) * rate_hz / static_cast<double>(spectrum.size());
}

inline double rms(std::span<const float> samples) {
    double sum = 0.0;
    for (const float sample : samples) sum += static_cast<double>(sample) * static_cast<double>(sample);
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace osteomill::testing
