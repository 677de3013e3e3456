#include "studies/stability/sites/site_verdict.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "simulation/loop/milling_session.h"

namespace osteomill::study {
namespace {

const auto mean_ticks = static_cast<std::size_t>(std::lround(mean_s / MillingSession::tick_s));
const auto settling_ticks = static_cast<std::size_t>(std::lround(settling_s / MillingSession::tick_s));

/// The most energy that forces gave a hand from any moment to any later one. `lead`: 0 where a tick's force
/// acts from it on, 1 where it acted on the way to it.
double energy_mj(const std::vector<SiteTick>& ticks, glm::dvec3 SiteTick::*force_n, std::size_t lead) {
    double sum_mj = 0.0;
    double lowest_mj = 0.0;
    double most_mj = 0.0;
    for (std::size_t i = 0; i + 1 < ticks.size(); ++i) {
        sum_mj += glm::dot(ticks[i + lead].*force_n, ticks[i + 1].hand_mm - ticks[i].hand_mm);
        lowest_mj = std::min(lowest_mj, sum_mj);
        most_mj = std::max(most_mj, sum_mj - lowest_mj);
    }
    return most_mj;
}

/// The mean of the ticks up to and with `last`.
glm::dvec3 mean_n(const std::vector<SiteTick>& ticks, std::size_t last, glm::dvec3 SiteTick::*force_n) {
    glm::dvec3 sum_n(0.0);
    for (std::size_t i = last + 1 - mean_ticks; i <= last; ++i) sum_n += ticks[i].*force_n;
    return sum_n / static_cast<double>(mean_ticks);
}

/// That the model gave the burr in the ticks up to and with `last`.
double energy_to_burr_mj(const std::vector<SiteTick>& ticks, std::size_t last) {
    double sum_mj = 0.0;
    for (std::size_t i = last + 1 - mean_ticks; i <= last; ++i)
        sum_mj += glm::dot(ticks[i].model_n, ticks[i].burr_mm - ticks[i - 1].burr_mm);
    return sum_mj;
}

/// The largest error of a force, beside its model's peak.
struct ForceError {
    double error_n = 0.0;
    double peak_n = least_peak_n;

    void add(const glm::dvec3& force_n, const glm::dvec3& model_n) {
        error_n = std::max(error_n, glm::distance(force_n, model_n));
        peak_n = std::max(peak_n, glm::length(model_n));
    }
    double percent() const { return 100.0 * error_n / peak_n; }
};

}  // namespace

SiteVerdict verdict_on(const SiteRun& run) {
    const std::vector<SiteTick>& ticks = run.ticks;
    SiteVerdict verdict{.energy_mj = energy_mj(ticks, &SiteTick::force_n, 0)};
    verdict.energy_over_rigid_mj = verdict.energy_mj - energy_mj(ticks, &SiteTick::rigid_n, 1);
    std::size_t turning = 0;
    double stuck_ms = 0.0;
    double noise_n2 = 0.0;
    std::size_t in_contact = 0;
    ForceError resisted;
    ForceError driven;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const double force_n = glm::length(ticks[i].force_n);
        verdict.peak_n = std::max(verdict.peak_n, force_n);
        verdict.largest_jump_n =
            std::max(verdict.largest_jump_n, glm::distance(ticks[i].force_n, ticks[i - 1].force_n));
        turning = ticks[i].spindle_on ? turning + 1 : 0;
        if (turning < std::max(settling_ticks, mean_ticks + 1)) {
            stuck_ms = 0.0;
            continue;
        }
        const glm::dvec3 model_n = mean_n(ticks, i, &SiteTick::model_n);
        const glm::dvec3 mean_force_n = mean_n(ticks, i, &SiteTick::force_n);
        if (force_n > 0.0) {
            const glm::dvec3 noise = ticks[i].force_n - mean_force_n;
            noise_n2 += glm::dot(noise, noise);
            ++in_contact;
        }
        (energy_to_burr_mj(ticks, i) > 0.0 ? driven : resisted).add(mean_force_n, model_n);
        const bool is_stuck = force_n > felt_n && glm::length(model_n) < nearly_nothing_n;
        stuck_ms = is_stuck ? stuck_ms + 1e3 * MillingSession::tick_s : 0.0;
        verdict.stuck_ms = std::max(verdict.stuck_ms, stuck_ms);
    }
    if (in_contact > 0) verdict.noise_n = std::sqrt(noise_n2 / static_cast<double>(in_contact));
    verdict.error_percent = resisted.percent();
    verdict.error_while_driven_percent = driven.percent();
    return verdict;
}

}  // namespace osteomill::study
