#include "tests/studies/stability/scene/verdict.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/studies/stability/scene/fast_part.h"

namespace osteomill::study {
namespace {

double largest_drawdown(std::span<const double> taken) {
    double most = 0.0;  // nothing was taken at the release
    double drawdown = 0.0;
    for (const double now : taken) {
        most = std::max(most, now);
        drawdown = std::max(drawdown, most - now);
    }
    return drawdown;
}

double storable_mj(std::span<const glm::dvec3> force_n, double spring_n_per_mm) {
    if (spring_n_per_mm <= 0.0) return 0.0;
    double most = 0.0;
    for (const glm::dvec3& force : force_n) most = std::max(most, glm::dot(force, force));
    return 0.5 * most / spring_n_per_mm;
}

double injected_mj(const JudgedRun& run) {
    return std::max(0.0, largest_drawdown(run.taken_mj) - largest_drawdown(run.truth_taken_mj) -
                             storable_mj(run.force_n, run.spring_n_per_mm));
}

double mean_length(std::span<const glm::dvec3> signal) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& sample : signal) sum += sample;
    return glm::length(sum) / static_cast<double>(signal.size());
}

/// Fast forces in the judged window, rms beyond the truth's.
struct FastForce {
    double all_n = 0.0;
    double first_half_n = 0.0;
    double second_half_n = 0.0;
    double limit_n = 0.0;

    bool is_dying() const { return second_half_n < dying_factor * first_half_n; }
    bool is_growing() const {
        return second_half_n > limit_n / 3.0 && second_half_n > growing_factor * first_half_n;
    }
    bool is_stable() const { return !is_growing() && (all_n < limit_n || is_dying()); }
};

/// Both of one length, with the fit's reach at either end.
FastForce fast_force(std::span<const glm::dvec3> force_n, std::span<const glm::dvec3> truth_force_n) {
    const std::vector<glm::dvec3> fast_n = fast_part(force_n);
    const std::vector<glm::dvec3> truth_fast_n = fast_part(truth_force_n);
    const auto beyond = [&](std::size_t begin, std::size_t count) {
        const double run_n = rms(std::span(fast_n).subspan(begin, count));
        const double truth_n = rms(std::span(truth_fast_n).subspan(begin, count));
        return std::sqrt(std::max(0.0, run_n * run_n - truth_n * truth_n));
    };
    const std::size_t half = fast_n.size() / 2;
    return {.all_n = beyond(0, fast_n.size()),
            .first_half_n = beyond(0, half),
            .second_half_n = beyond(half, fast_n.size() - half),
            .limit_n = std::max(least_limit_cycle_n, limit_cycle_share * mean_length(truth_force_n))};
}

}  // namespace

Verdict verdict_on(const JudgedRun& run) {
    Verdict verdict{.injected_mj = injected_mj(run)};
    const std::size_t end = std::min(run.window_ends + fit_reach_ticks, run.force_n.size());
    const std::size_t begin =
        std::min(run.window_begins - std::min(fit_reach_ticks, run.window_begins), end / 2);
    if (end - begin <= 2 * fit_reach_ticks) return verdict;  // astray before it could be judged

    const FastForce fast =
        fast_force(run.force_n.subspan(begin, end - begin), run.truth_force_n.subspan(begin, end - begin));
    verdict.limit_cycle_n = fast.all_n;
    const double taken_mj = run.taken_mj.empty() ? 0.0 : run.taken_mj.back();
    verdict.is_stable = !run.is_astray && fast.is_stable() &&
                        verdict.injected_mj < std::max(least_injection_mj, injection_share * taken_mj);
    return verdict;
}

}  // namespace osteomill::study
