#include "simulation/loop/cut_report.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/scene/burr.h"
#include "simulation/engagement/engagement.h"
#include "simulation/loop/spindle_torque.h"

namespace osteomill {

namespace {

/// For the rounding of sums of periods, s.
constexpr double report_tolerance_s = 1e-7;

}  // namespace

CutReport::CutReport(std::vector<Burr> burrs, std::optional<Motor> motor)
    : burrs_(std::move(burrs)), motor_(motor) {}

void CutReport::add(const MillingResult& result, double elapsed_s) noexcept {
    elapsed_s_ += elapsed_s;
    if (result.valid && result.spindle_on) impulse_n_s_ += glm::length(result.force_n) * elapsed_s;
}

bool CutReport::is_due() const noexcept {
    return elapsed_s_ >= period_s - report_tolerance_s;
}

std::optional<CutState> CutReport::take(const MillingResult& latest, double speed_share) noexcept {
    const double elapsed_s = std::exchange(elapsed_s_, 0.0);
    const double force_n = std::exchange(impulse_n_s_, 0.0) / elapsed_s;
    const glm::dvec3 moved_mm = latest.pose.position_mm - position_mm_;
    const bool has_feed = has_position_ && is_finite(moved_mm);
    position_mm_ = latest.pose.position_mm;
    has_position_ = is_finite(position_mm_);
    if (!latest.spindle_on || !std::isfinite(force_n)) {
        force_n_ = 0.0;
        return std::nullopt;
    }
    force_n_ += elapsed_s / (remembers_s + elapsed_s) * (force_n - force_n_);
    if (force_n_ < least_force_n || latest.burr >= burrs_.size()) return std::nullopt;
    if (force_n > 0.0) look_at(latest, speed_share, has_feed ? moved_mm / elapsed_s : glm::dvec3(0.0));
    last_.force_n = force_n_;
    return last_;
}

void CutReport::look_at(const MillingResult& latest, double speed_share,
                        const glm::dvec3& feed_mm_per_s) noexcept {
    const Burr& burr = burrs_.turn(latest.burr, speed_share);
    const Sums sums = sum(latest, burr, feed_mm_per_s);
    last_ = {.tooth_ripple_n = sums.ripple_n(), .relative_stiffness = sums.relative_stiffness()};
    if (motor_)
        last_.loaded_rpm = 60.0 * burr.spindle_rev_per_s * speed_share_under(*motor_, sums.torque_n_mm);
}

CutReport::Sums CutReport::sum(const MillingResult& latest, const Burr& burr,
                               const glm::dvec3& feed_mm_per_s) const noexcept {
    const Engagement& engagement = latest.engagement;
    const glm::dmat3 frame = burr_frame(latest.pose.spindle_axis);
    Sums sums;
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        if (!cuts(patch, feed_mm_per_s, engagement.spacing_mm)) continue;
        const double advance_mm_per_s = glm::dot(patch.normal, feed_mm_per_s);
        const glm::dvec3 chip_n = advance_mm_per_s * patch.cutting_n_s_per_mm;
        const glm::dvec3 force_n = chip_n + patch.edge_n;
        const double x = glm::dot(patch.normal, frame[0]);
        const double y = glm::dot(patch.normal, frame[1]);
        const double azimuth_rad = std::atan2(y, x);
        sums.cosine_n += 2.0 * std::cos(burr.edges * azimuth_rad) * force_n;
        sums.sine_n += 2.0 * std::sin(burr.edges * azimuth_rad) * force_n;

        const double lever_mm = patch_lever_mm(burr, std::hypot(x, y));
        const glm::dvec3 along_turn = -std::sin(azimuth_rad) * frame[0] + std::cos(azimuth_rad) * frame[1];
        sums.torque_n_mm -= burr.sigma() * lever_mm * glm::dot(force_n, along_turn);
        const double weight_n = glm::length(chip_n);
        sums.chips_n += weight_n;
        sums.stiffness_chips_n += weight_n * patch_stiffness(patch, burr, lever_mm);
    }
    return sums;
}

double CutReport::Sums::ripple_n() const noexcept {
    const double ripple_n = std::sqrt(glm::dot(cosine_n, cosine_n) + glm::dot(sine_n, sine_n));
    return std::isfinite(ripple_n) ? ripple_n : 0.0;
}

double CutReport::Sums::relative_stiffness() const noexcept {
    const double mean = stiffness_chips_n / chips_n;
    return std::isfinite(mean) ? mean : 1.0;
}

}  // namespace osteomill
