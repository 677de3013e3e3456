#include "simulation/coupling/handpiece_vibration.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/scene/burr.h"

namespace osteomill {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Gaps of freshly carved bone scatter by a tenth of a voxel.
constexpr double touching_gap_voxels = 0.2;
/// A longer step in a tick is a jump of the device, not the motion of a hand.
constexpr double longest_move_mm = 5.0;  // at the arm

double tooth_hz(const Burr& burr) {
    return burr.edges * burr.spindle_rev_per_s;
}

/// A feed that turns with the spindle and makes the same chips as run-out.
double whirl_mm_per_s(const Burr& burr) {
    return burr.run_out_mm * std::sin(std::numbers::pi / burr.edges) * tooth_hz(burr);
}

bool renders_turn(const Burr& burr) {
    return burr.spindle_rev_per_s <= HandpieceVibration::highest_hz && burr.edges > 1;
}

bool renders_tooth(const Burr& burr) {
    return tooth_hz(burr) <= HandpieceVibration::highest_hz;
}

/// cos and sin of `times` the azimuth of a direction across the spindle; a point on the axis has the azimuth
/// of x.
std::complex<double> unit_power(double x, double y, int times) {
    const double length = std::hypot(x, y);
    if (length == 0.0) return 1.0;
    const std::complex<double> unit(x / length, y / length);
    std::complex<double> power = 1.0;
    for (int i = 0; i < times; ++i) power *= unit;
    return power;
}

double share_of(double elapsed_s) {
    return elapsed_s / (HandpieceVibration::follows_s + elapsed_s);
}

}  // namespace

bool vibrates_in_reach(const Burr& burr) noexcept {
    return (renders_turn(burr) && burr.run_out_mm > 0.0) || renders_tooth(burr);
}

glm::dvec3 HandpieceVibration::Sine::at(double angle_rad) const noexcept {
    return std::cos(angle_rad) * cosine_n + std::sin(angle_rad) * sine_n;
}

double HandpieceVibration::Sine::amplitude_n() const noexcept {
    const double c = glm::dot(cosine_n, cosine_n);
    const double s = glm::dot(sine_n, sine_n);
    return std::sqrt(0.5 * (c + s) + std::hypot(0.5 * (c - s), glm::dot(cosine_n, sine_n)));
}

bool HandpieceVibration::Sine::is_finite() const noexcept {
    return osteomill::is_finite(cosine_n) && osteomill::is_finite(sine_n);
}

void HandpieceVibration::Sine::limit(double amplitude_n) noexcept {
    const double wanted_n = this->amplitude_n();
    if (wanted_n <= amplitude_n) return;
    cosine_n *= amplitude_n / wanted_n;
    sine_n *= amplitude_n / wanted_n;
}

void HandpieceVibration::Sine::follow(const Sine& target, double share) noexcept {
    cosine_n += share * (target.cosine_n - cosine_n);
    sine_n += share * (target.sine_n - sine_n);
    if (target.amplitude_n() == 0.0 && amplitude_n() < silent_n) *this = {};
}

HandpieceVibration::HandpieceVibration(std::vector<Burr> burrs, const VibrationLimits& limits)
    : burrs_(std::move(burrs)), limits_(limits) {}

void HandpieceVibration::follow_hand(const glm::dvec3& hand_mm) noexcept {
    const glm::dvec3 moved_mm = hand_mm - hand_mm_;
    const bool follows = has_hand_ && glm::length(moved_mm) <= limits_.scale.length_mm(longest_move_mm);
    has_hand_ = is_finite(hand_mm);
    hand_mm_ = hand_mm;
    const double most_mj = limits_.scale.energy_mj(most_store_mj);
    if (follows) store_mj_ = std::min(store_mj_ - glm::dot(force_n_, moved_mm), most_mj);
}

void HandpieceVibration::silence() noexcept {
    turn_ = turn_target_ = tooth_ = tooth_target_ = {};
    has_result_ = false;
    feed_mm_per_s_ = force_n_ = glm::dvec3(0.0);
}

void HandpieceVibration::look_at_cut(const MillingResult& latest, const Burr& burr) noexcept {
    if (has_result_ && latest.step == step_) return;
    const glm::dvec3 moved_mm = latest.pose.position_mm - burr_mm_;
    const double elapsed_s = latest.time_s - result_s_;
    const bool follows = has_result_ && elapsed_s > 0.0 && is_finite(latest.force_n) && is_finite(moved_mm);
    has_result_ = latest.step > 0;
    step_ = latest.step;
    result_s_ = latest.time_s;
    burr_mm_ = latest.pose.position_mm;
    turn_target_ = tooth_target_ = {};
    if (!follows) return;
    store_mj_ -= share_of_work * glm::dot(latest.force_n, moved_mm);
    feed_mm_per_s_ += share_of(elapsed_s) * (moved_mm / elapsed_s - feed_mm_per_s_);
    if (latest.force_n != glm::dvec3(0.0)) aim(latest.engagement, burr_frame(latest.pose.spindle_axis), burr);
}

void HandpieceVibration::aim(const Engagement& engagement, const glm::dmat3& frame,
                             const Burr& burr) noexcept {
    const double whirl = whirl_mm_per_s(burr);
    glm::dvec3 chips_n(0.0);
    glm::dvec3 edges_n(0.0);
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        const double advance_mm_per_s = glm::dot(patch.normal, feed_mm_per_s_);
        if (advance_mm_per_s <= 0.0 || patch.gap_mm > touching_gap_voxels * engagement.spacing_mm) continue;
        const double x = glm::dot(patch.normal, frame[0]);
        const double y = glm::dot(patch.normal, frame[1]);
        const glm::dvec3 chip_n = advance_mm_per_s * patch.cutting_n_s_per_mm;
        chips_n += chip_n;
        edges_n += patch.edge_n;
        turn_target_.cosine_n += whirl * x * patch.cutting_n_s_per_mm;
        turn_target_.sine_n += whirl * y * patch.cutting_n_s_per_mm;
        if (!renders_tooth(burr)) continue;
        const std::complex<double> azimuth = unit_power(x, y, burr.edges);
        tooth_target_.cosine_n += 2.0 * azimuth.real() * (chip_n + patch.edge_n);
        tooth_target_.sine_n += 2.0 * azimuth.imag() * (chip_n + patch.edge_n);
    }
    turn_target_.limit(glm::length(chips_n));
    tooth_target_.limit(glm::length(chips_n + edges_n));
    if (!turn_target_.is_finite()) turn_target_ = {};
    if (!tooth_target_.is_finite()) tooth_target_ = {};
}

glm::dvec3 HandpieceVibration::allowed_n(const Burr& burr, double tick_s, double mean_n) const noexcept {
    const double turn_n = turn_.amplitude_n();
    const double tooth_n = tooth_.amplitude_n();
    const double room_n = limits_.max_force_n - mean_n;
    if (!(turn_n + tooth_n > 0.0 && room_n > 0.0)) return glm::dvec3(0.0);
    const double payable_n =
        std::max(0.0, store_mj_) / (limits_.scale.speed_mm_per_s(fastest_mm_per_s) * tick_s);
    const double slew_n_per_s = two_pi * (turn_n * burr.spindle_rev_per_s + tooth_n * tooth_hz(burr));
    const double share = std::min({1.0, room_n / (turn_n + tooth_n), payable_n / (turn_n + tooth_n),
                                   share_of_slew * limits_.max_slew_n_per_s / slew_n_per_s});
    const double angle_rad = burr.sigma() * two_pi * turned_rev_;
    return share * (turn_.at(angle_rad) + tooth_.at(burr.edges * angle_rad));
}

glm::dvec3 HandpieceVibration::tick(const HandState& hand, const MillingResult& latest,
                                    const glm::dvec3& mean_force_n, bool is_felt) noexcept {
    follow_hand(hand.pose.position_mm);
    if (!is_felt || !hand.spindle_on) {
        silence();
        return force_n_;
    }
    const Burr& burr = burrs_.turn(hand.burr, hand.speed_share);
    turned_rev_ += burr.spindle_rev_per_s * hand.tick_s;
    turned_rev_ -= std::floor(turned_rev_);
    look_at_cut(latest, burr);
    turn_.follow(renders_turn(burr) ? turn_target_ : Sine{}, share_of(hand.tick_s));
    tooth_.follow(tooth_target_, share_of(hand.tick_s));
    return force_n_ = allowed_n(burr, hand.tick_s, glm::length(mean_force_n));
}

}  // namespace osteomill
