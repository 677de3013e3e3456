#include "haptic_server/measuring/pushed_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace osteomill {

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
