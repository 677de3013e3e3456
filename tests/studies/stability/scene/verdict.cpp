#include "tests/studies/stability/scene/verdict.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

glm::dvec3 mean(std::span<const glm::dvec3> signal) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& sample : signal) sum += sample;
    return sum / static_cast<double>(signal.size());
}

/// What a rms is beyond another, as if they were independent.
double beyond(double rms_n, double truth_rms_n) {
    return std::sqrt(std::max(0.0, rms_n * rms_n - truth_rms_n * truth_rms_n));
}

}  // namespace

Verdict verdict_on(const JudgedRun& run) {
    Verdict verdict;
    verdict.injected_mj =
        std::max(0.0, largest_drawdown(run.taken_mj) - largest_drawdown(run.truth_taken_mj) -
                          storable_mj(run.force_n, run.spring_n_per_mm));

    const std::size_t first = run.window_begins - fit_reach_ticks;
    const std::size_t last = std::min(run.window_ends + fit_reach_ticks, run.force_n.size());
    if (last <= first + 2 * fit_reach_ticks) return verdict;
    const auto fast = fast_part(run.force_n.subspan(first, last - first));
    const auto truth_fast = fast_part(run.truth_force_n.subspan(first, last - first));
    const std::span<const glm::dvec3> all(fast);
    const double truth_rms_n = rms(truth_fast);
    verdict.limit_cycle_n = beyond(rms(all), truth_rms_n);

    const auto window =
        run.truth_force_n.subspan(run.window_begins, last - fit_reach_ticks - run.window_begins);
    const double limit_n = std::max(least_limit_cycle_n, limit_cycle_share * glm::length(mean(window)));
    const double before_n = beyond(rms(all.first(all.size() / 2)), truth_rms_n);
    const double after_n = beyond(rms(all.last(all.size() / 2)), truth_rms_n);
    const bool grows = after_n > limit_n / 3.0 && after_n > growth_factor * before_n;

    const double taken_mj = run.taken_mj.empty() ? 0.0 : std::max(0.0, run.taken_mj.back());
    const double most_injected_mj = std::max(least_injection_mj, injection_share * taken_mj);
    verdict.is_stable =
        !run.is_astray && verdict.limit_cycle_n < limit_n && !grows && verdict.injected_mj < most_injected_mj;
    return verdict;
}

}  // namespace osteomill::study
