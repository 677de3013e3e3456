#include "studies/stability/map/fast_part.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::study {
namespace {

constexpr std::size_t width = 2 * fit_reach_ticks + 1;

/// w_k = 3 (3 m^2 + 3 m - 1 - 5 k^2) / ((2 m - 1) (2 m + 1) (2 m + 3)).
std::array<double, width> weights_of_fit() {
    constexpr double m = fit_reach_ticks;
    std::array<double, width> weights{};
    for (std::size_t i = 0; i < width; ++i) {
        const double k = static_cast<double>(i) - m;
        weights[i] = 3.0 * (3.0 * m * m + 3.0 * m - 1.0 - 5.0 * k * k) /
                     ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
    }
    return weights;
}

}  // namespace

std::vector<glm::dvec3> fast_part(std::span<const glm::dvec3> signal) {
    std::vector<glm::dvec3> fast;
    const std::array<double, width> weights = weights_of_fit();
    for (std::size_t first = 0; first + width <= signal.size(); ++first) {
        glm::dvec3 slow(0.0);
        for (std::size_t i = 0; i < width; ++i) slow += weights[i] * signal[first + i];
        fast.push_back(signal[first + fit_reach_ticks] - slow);
    }
    return fast;
}

double rms(std::span<const glm::dvec3> signal) {
    if (signal.empty()) return 0.0;
    double squares = 0.0;
    for (const glm::dvec3& sample : signal) squares += glm::dot(sample, sample);
    return std::sqrt(squares / static_cast<double>(signal.size()));
}

}  // namespace osteomill::study
