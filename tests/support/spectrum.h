// Amplitudes of the sines that a signal of evenly spaced samples is made of.
#pragma once

#include <cmath>
#include <complex>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

namespace osteomill::testing {

/// The amplitude of the sine at `frequency_hz` in samples `tick_s` apart, through a Hann window, so that slow
/// drift does not leak into it. Root of the sum of squares over the axes.
inline double amplitude_at(std::span<const glm::dvec3> samples, double frequency_hz, double tick_s = 0.001) {
    constexpr double two_pi = 2.0 * std::numbers::pi;
    const auto count = static_cast<double>(samples.size());
    double sum_of_squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        std::complex<double> sum = 0.0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const auto at = static_cast<double>(i);
            const double window = 1.0 - std::cos(two_pi * at / count);
            sum += window * samples[i][axis] * std::polar(1.0, -two_pi * frequency_hz * tick_s * at);
        }
        sum_of_squares += std::norm(sum * 2.0 / count);
    }
    return std::sqrt(sum_of_squares);
}

}  // namespace osteomill::testing
