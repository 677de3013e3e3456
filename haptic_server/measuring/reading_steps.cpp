#include "haptic_server/measuring/reading_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace osteomill {

namespace {

/// Less is rounding.
constexpr double least_change_mm = 1e-7;
constexpr std::size_t least_changes = 12;
constexpr std::ptrdiff_t quiet_ticks = 2;
/// Steps of the encoders are not that unlike; motions of an arm that sticks and slips are.
constexpr double most_unlike = 4.0;
/// With fewer ticks that repeat the last reading there are no steps to see.
constexpr double least_repeats = 0.02;

/// The value that the share `below` of them lies under; 0 for none.
double quantile(std::vector<double> values, double below) {
    if (values.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(below * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + at);
    return values[static_cast<std::size_t>(at)];
}

}  // namespace

double encoder_step_mm(std::span<const MeasuredTick> ticks) {
    std::vector<double> changes_mm;  // of each tick
    std::array<std::vector<double>, 3> by_axis_mm;
    std::size_t repeats = 0;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const glm::dvec3 change = ticks[i].position_mm - ticks[i - 1].position_mm;
        for (int k = 0; k < 3; ++k)
            if (std::abs(change[k]) > least_change_mm)
                by_axis_mm[static_cast<std::size_t>(k)].push_back(std::abs(change[k]));
            else
                ++repeats;
        changes_mm.push_back(glm::length(change));
    }
    if (static_cast<double>(repeats) < least_repeats * 3.0 * static_cast<double>(changes_mm.size()))
        return 0.0;

    std::vector<double> alone_mm;
    const auto count = static_cast<std::ptrdiff_t>(changes_mm.size());
    for (std::ptrdiff_t i = quiet_ticks; i + quiet_ticks < count; ++i) {
        const auto is_still = [&](std::ptrdiff_t j) {
            return j == i || changes_mm[static_cast<std::size_t>(j)] <= least_change_mm;
        };
        bool is_alone = !(changes_mm[static_cast<std::size_t>(i)] <= least_change_mm);
        for (std::ptrdiff_t j = i - quiet_ticks; j <= i + quiet_ticks; ++j)
            is_alone = is_alone && is_still(j);
        if (is_alone) alone_mm.push_back(changes_mm[static_cast<std::size_t>(i)]);
    }
    if (alone_mm.size() >= least_changes) {
        const double step_mm = quantile(alone_mm, 0.4);
        return step_mm > most_unlike * quantile(std::move(alone_mm), 0.1) ? 0.0 : step_mm;
    }
    double step_mm = 0.0;
    for (std::vector<double>& changes : by_axis_mm)
        if (changes.size() >= least_changes) step_mm = std::max(step_mm, quantile(std::move(changes), 0.1));
    return step_mm;
}

double reading_noise_mm(std::span<const MeasuredTick> at_rest) {
    constexpr std::size_t window = 50;
    double noise_mm = 0.0;
    for (int k = 0; k < 3; ++k) {
        std::vector<double> variances;
        for (std::size_t begin = 0; begin + window <= at_rest.size(); begin += window) {
            double sum = 0.0;
            for (std::size_t i = begin + 2; i < begin + window; ++i) {
                const double second = at_rest[i].position_mm[k] - 2.0 * at_rest[i - 1].position_mm[k] +
                                      at_rest[i - 2].position_mm[k];
                sum += second * second;
            }
            variances.push_back(sum / (6.0 * static_cast<double>(window - 2)));
        }
        noise_mm = std::max(noise_mm, std::sqrt(quantile(std::move(variances), 0.25)));
    }
    return noise_mm;
}

}  // namespace osteomill
