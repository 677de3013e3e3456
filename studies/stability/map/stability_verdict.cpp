#include "studies/stability/map/stability_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

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

/// Fast forces of run and truth, entry i at tick i + fit_reach_ticks.
class FastForce {
  public:
    explicit FastForce(const JudgedRun& run)
        : run_n_(fast_part(run.force_n)), truth_n_(fast_part(run.truth_force_n.first(run.force_n.size()))) {}

    /// Rms of the run's beyond the truth's, over entries [begin, end).
    double beyond_n(std::size_t begin, std::size_t end) const {
        const double run_n = rms(std::span(run_n_).subspan(begin, end - begin));
        const double truth_n = rms(std::span(truth_n_).subspan(begin, end - begin));
        return std::sqrt(std::max(0.0, run_n * run_n - truth_n * truth_n));
    }
    std::size_t size() const { return run_n_.size(); }

  private:
    std::vector<glm::dvec3> run_n_;
    std::vector<glm::dvec3> truth_n_;
};

bool has_been_dying(const FastForce& fast, std::size_t end, double limit_n) {
    constexpr std::size_t parts = 4;
    if (fast.beyond_n(0, end / parts) < limit_n) return false;  // there was none
    for (std::size_t part = 1; part < parts; ++part) {
        const double before_n = fast.beyond_n((part - 1) * end / parts, part * end / parts);
        const double after_n = fast.beyond_n(part * end / parts, (part + 1) * end / parts);
        if (after_n > dying_factor * before_n) return false;
    }
    return true;
}

/// The rms of the fast force that counts as small.
double most_small_n(const JudgedRun& run) {
    const auto window = run.truth_force_n.subspan(run.window_begins, run.window_ends - run.window_begins);
    return std::max(least_limit_cycle_n, limit_cycle_share * mean_length(window)) +
           0.5 * run.spring_n_per_mm * run.encoder_step_mm;
}

double deviation_n(std::span<const glm::dvec3> force_n, std::span<const glm::dvec3> truth_force_n) {
    std::vector<glm::dvec3> deviation;
    for (std::size_t i = force_n.size() / 2; i < force_n.size(); ++i)
        deviation.push_back(force_n[i] - truth_force_n[i]);
    return rms(deviation);
}

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

Verdict verdict_on(const JudgedRun& run) {
    Verdict verdict{.injected_mj = injected_mj(run)};
    const FastForce fast(run);
    if (fast.size() == 0) {
        verdict.limit_cycle_n = deviation_n(run.force_n, run.truth_force_n);
        return verdict;  // a run ends that early only astray
    }
    const std::size_t end = std::min(run.window_ends - fit_reach_ticks, fast.size());
    const std::size_t begin = std::min(run.window_begins - fit_reach_ticks, end / 2);
    const std::size_t middle = (begin + end) / 2;
    verdict.limit_cycle_n = fast.beyond_n(begin, end);

    const double limit_n = most_small_n(run);
    const double after_n = fast.beyond_n(middle, end);
    const bool is_growing =
        after_n > limit_n / 3.0 && after_n > growing_factor * fast.beyond_n(begin, middle);
    const double most_injected_mj = std::max(least_injection_mj, injection_share * run.taken_mj.back());
    const bool is_small = verdict.limit_cycle_n < limit_n && verdict.injected_mj < most_injected_mj;
    verdict.is_stable = !run.is_astray && !is_growing && (is_small || has_been_dying(fast, end, limit_n));
    return verdict;
}

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
