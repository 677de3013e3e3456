#include "haptic_server/measuring/arm_estimates.h"

#include <Eigen/Cholesky>
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

namespace {

constexpr double half_window_s = 0.030;
constexpr std::ptrdiff_t half_window_ticks = 30;
constexpr std::ptrdiff_t hop_ticks = 5;
constexpr std::ptrdiff_t half_speed_ticks = 4;
constexpr double most_delay_ticks = 12.0;
constexpr double delay_step_ticks = 0.1;
/// A motion over fewer steps says too little.
constexpr double least_steps = 4.0;
constexpr double least_travel_mm = 0.05;
constexpr double least_explained = 0.7;

/// The bump w(t) = (1 - (t / h)^2)^4, and its derivatives; t within -h to h.
struct Bump {
    double value, slope_per_s, bend_per_s2;
};

Bump bump(double t_s) {
    const double s = t_s / half_window_s;
    if (std::abs(s) >= 1.0) return {0.0, 0.0, 0.0};
    const double r = 1.0 - s * s;
    return {r * r * r * r, -8.0 * s * r * r * r / half_window_s,
            (-8.0 * r * r * r + 48.0 * s * s * r * r) / (half_window_s * half_window_s)};
}

using Unknowns = Eigen::Matrix<double, 5, 1>;  // m, b, k, c, F_c

struct Fit {
    Unknowns solution;
    double left_over = 0.0;
};

}  // namespace

std::optional<PushedMotion> pushed_motion(std::span<const MeasuredTick> ticks, std::size_t axis,
                                          double step_mm) {
    constexpr double dt = measuring_tick_s;
    constexpr double m_per_mm = 0.001;
    const auto count = static_cast<std::ptrdiff_t>(ticks.size());
    const auto k = static_cast<glm::length_t>(axis);
    const auto x_m = [&](std::ptrdiff_t i) {
        return m_per_mm * ticks[static_cast<std::size_t>(i)].position_mm[k];
    };
    const auto force_n = [&](std::ptrdiff_t i) { return ticks[static_cast<std::size_t>(i)].force_n[k]; };
    const auto first = half_window_ticks + static_cast<std::ptrdiff_t>(most_delay_ticks) + 1;
    if (count < 2 * first) return std::nullopt;

    const double turning_m_per_s = std::max(0.003, m_per_mm * step_mm / (2.0 * half_speed_ticks * dt));
    const auto sense = [&](std::ptrdiff_t i) {
        const std::ptrdiff_t from = std::max<std::ptrdiff_t>(i - half_speed_ticks, 0);
        const std::ptrdiff_t to = std::min(i + half_speed_ticks, count - 1);
        return std::tanh((x_m(to) - x_m(from)) / (dt * static_cast<double>(to - from)) / turning_m_per_s);
    };

    std::vector<Unknowns> lines;
    std::vector<std::ptrdiff_t> middles;
    double travel_m = 0.0;
    for (std::ptrdiff_t middle = first; middle + first <= count; middle += hop_ticks) {
        Unknowns line = Unknowns::Zero();
        double low = x_m(middle);
        double high = low;
        const double here = low;  // differences of places are small: no rounding
        for (std::ptrdiff_t j = -half_window_ticks; j <= half_window_ticks; ++j) {
            const Bump w = bump(dt * static_cast<double>(j));
            const double x = x_m(middle + j);
            low = std::min(low, x);
            high = std::max(high, x);
            line += dt * Unknowns(w.bend_per_s2 * (x - here), -w.slope_per_s * (x - here), w.value * x,
                                  w.value, w.value * sense(middle + j));
        }
        travel_m = std::max(travel_m, high - low);
        lines.push_back(line);
        middles.push_back(middle);
    }
    if (travel_m < m_per_mm * std::max(least_travel_mm, least_steps * step_mm)) return std::nullopt;

    Eigen::Matrix<double, 5, 5> products = Eigen::Matrix<double, 5, 5>::Zero();
    for (const Unknowns& line : lines) products += line * line.transpose();
    const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver(products);

    const auto pushes = [&](double delay_ticks) {
        std::vector<double> sums;
        for (const std::ptrdiff_t middle : middles) {
            double sum = 0.0;
            const auto back = static_cast<std::ptrdiff_t>(delay_ticks) + 1;
            for (std::ptrdiff_t j = -half_window_ticks - back; j <= half_window_ticks; ++j)
                sum +=
                    dt * bump(dt * (static_cast<double>(j) + 0.5 + delay_ticks)).value * force_n(middle + j);
            sums.push_back(sum);
        }
        return sums;
    };
    const auto fit = [&](double delay_ticks) {
        const std::vector<double> sums = pushes(delay_ticks);
        Unknowns right = Unknowns::Zero();
        for (std::size_t i = 0; i < lines.size(); ++i) right += lines[i] * sums[i];
        Fit found{.solution = solver.solve(right)};
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const double off = sums[i] - lines[i].dot(found.solution);
            found.left_over += off * off;
        }
        return found;
    };

    double delay_ticks = 0.0;
    Fit best = fit(0.0);
    for (double tried = delay_step_ticks; tried <= most_delay_ticks; tried += delay_step_ticks)
        if (const Fit other = fit(tried); other.left_over < best.left_over) {
            best = other;
            delay_ticks = tried;
        }

    const std::vector<double> sums = pushes(delay_ticks);
    double all = 0.0;
    for (const double sum : sums) all += sum * sum;
    const double explained = all > 0.0 ? 1.0 - best.left_over / all : 0.0;
    if (!(explained > least_explained) || !(best.solution[0] > 0.0)) return std::nullopt;
    return PushedMotion{.mass_kg = best.solution[0],
                        .friction_n = std::max(0.0, best.solution[4]),
                        .delay_ticks = delay_ticks,
                        .explained = explained};
}

}  // namespace osteomill
