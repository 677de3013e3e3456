#include "devices/tracker/sampled_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/session/operator_command.h"

namespace osteomill {

namespace {

constexpr double drift_s_per_s = 1e-3;
constexpr double lateness_memory_s = 20.0;
/// A sample that is a little later than any was does not hold playback up.
constexpr double lateness_margin = 1.1;
/// Stamps that step by more than this were set, not measured.
constexpr double longest_step_s = 1.0;
/// And so are those that step back by more than a measurement's noise: a stream is in order.
constexpr double longest_step_back_s = 0.05;
/// For so long a clock that ran ahead has to keep pace with ours before it is trusted again.
constexpr double gain_memory_s = 1.0;
constexpr double most_gain_s = 2.0 * SampledMotion::longest_behind_s;
constexpr double silent_periods = 5.0;
constexpr double delay_periods = 2.0;
/// Playback that is off by so much of a period is brought back at the full rate.
constexpr double in_time_periods = 0.5;

glm::dvec3 shortened(const glm::dvec3& v, double longest) noexcept {
    const double length = glm::length(v);
    return length > longest ? v * (longest / length) : v;
}

/// Whether a hand may have come from one to the other.
bool is_reachable(const SampledMotion::Sample& from, const SampledMotion::Sample& to) noexcept {
    const double span_s = std::abs(to.stamp_s - from.stamp_s);
    const double way_mm = glm::distance(from.position_mm, to.position_mm);
    const double turn_rad = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(from.turn, to.turn))));
    return way_mm <= SampledMotion::noise_mm + fastest_hand_mm_per_s * span_s &&
           turn_rad <= SampledMotion::turn_noise_rad + SampledMotion::fastest_turn_rad_per_s * span_s;
}

}  // namespace

void SampledMotion::begin_anew() noexcept {
    count_ = 0;
    differences_ = 0;
    outlier_.reset();
    plays_ = false;
}

void SampledMotion::learn_period(double difference_s) noexcept {
    differences_s_[differences_ % period_samples] = difference_s;
    ++differences_;
    std::array<double, period_samples> sorted = differences_s_;
    const std::size_t known = std::min(differences_, period_samples);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(known / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(known));
    period_s_ = std::clamp(*middle, 1.0 / fastest_rate_hz, 1.0 / slowest_rate_hz);
}

void SampledMotion::learn_lateness(const Sample& sample, double since_last_s) noexcept {
    const double apart_s = sample.arrival_s - sample.stamp_s;
    const double before_s = offset_s_;
    offset_s_ = std::min(apart_s, offset_s_ + drift_s_per_s * since_last_s);
    // Samples that came at once tell nothing of the clock's rate.
    const double gain_s = since_last_s > 0.0 ? std::max(0.0, before_s - offset_s_) : 0.0;
    gained_s_ = std::min(gained_s_ * std::exp(-since_last_s / gain_memory_s) + gain_s, most_gain_s);
    lateness_s_ = std::max(apart_s - offset_s_, lateness_s_ * std::exp(-since_last_s / lateness_memory_s));
}

bool SampledMotion::was_set(const Sample& sample) const noexcept {
    if (!last_) return true;
    const double step_s = sample.stamp_s - last_->stamp_s;
    const double waited_s = sample.arrival_s - last_->arrival_s;
    return std::abs(step_s - waited_s) > longest_step_s || step_s < -longest_step_back_s;
}

SampledMotion::ClockFault SampledMotion::judge_clock() const noexcept {
    if (gained_s_ > longest_behind_s) return ClockFault::ahead;
    const double late_s = newest().arrival_s - newest().stamp_s - offset_s_;
    const bool is_behind = delay_periods * period_s_ + late_s > longest_delay_s + longest_behind_s;
    return is_behind ? ClockFault::behind : ClockFault::none;
}

void SampledMotion::take(Sample sample) noexcept {
    if (sample.stamp_s == 0.0) {
        sample.stamp_s = sample.arrival_s;
        // Samples that a link held up and gave at once were not measured at once.
        if (count_ > 0 && sample.arrival_s - newest().arrival_s < longest_step_s)
            sample.stamp_s = std::clamp(newest().stamp_s + 0.5 * period_s_, sample.arrival_s,
                                        sample.arrival_s + most_silence_s);
    }
    if (was_set(sample)) {
        begin_anew();
        offset_s_ = sample.arrival_s - sample.stamp_s;
        return keep(sample);
    }
    const double step_s = sample.stamp_s - last_->stamp_s;
    const double waited_s = sample.arrival_s - last_->arrival_s;
    if (step_s < least_apart_s) return;
    if (count_ == 0) {
        learn_lateness(sample, waited_s);
        return keep(sample);
    }
    if (waited_s <= longest_step_s && is_reachable(newest(), sample)) {
        learn_period(step_s);
        learn_lateness(sample, waited_s);
        return keep(sample);
    }
    const bool is_confirmed = outlier_ && is_reachable(*outlier_, sample);
    outlier_ = sample;
    if (waited_s <= longest_step_s && !is_confirmed) return;
    begin_anew();
    learn_lateness(sample, waited_s);
    keep(sample);
}

void SampledMotion::keep(const Sample& sample) noexcept {
    outlier_.reset();
    last_ = sample;
    // A playback that begins has nothing to wait for but this.
    if (count_ == 0) lateness_s_ = sample.arrival_s - sample.stamp_s - offset_s_;
    if (count_ == most_samples) {
        first_ = (first_ + 1) % most_samples;
        --count_;
    }
    samples_[(first_ + count_) % most_samples] = sample;
    ++count_;
}

glm::dvec3 SampledMotion::slope(std::size_t i) const noexcept {
    const auto chord = [&](std::size_t from) {
        return (nth(from + 1).position_mm - nth(from).position_mm) /
               (nth(from + 1).stamp_s - nth(from).stamp_s);
    };
    if (i == 0) return shortened(chord(0), fastest_hand_mm_per_s);
    const double before_s = nth(i).stamp_s - nth(i - 1).stamp_s;
    const double after_s = nth(i + 1).stamp_s - nth(i).stamp_s;
    return shortened((after_s * chord(i - 1) + before_s * chord(i)) / (before_s + after_s),
                     fastest_hand_mm_per_s);
}

SampledMotion::Pose SampledMotion::pose_between(std::size_t i, double time_s) const noexcept {
    const Sample& from = nth(i);
    const Sample& to = nth(i + 1);
    const double span_s = to.stamp_s - from.stamp_s;
    const double u = std::clamp((time_s - from.stamp_s) / span_s, 0.0, 1.0);
    const glm::dvec3 a = span_s * slope(i);
    const glm::dvec3 b = span_s * slope(i + 1);
    const glm::dvec3 way = to.position_mm - from.position_mm;
    // Hermite: from + a u + (3 way - 2 a - b) u^2 + (a + b - 2 way) u^3
    const glm::dvec3 square = 3.0 * way - 2.0 * a - b;
    const glm::dvec3 cube = a + b - 2.0 * way;
    const glm::dvec3 curve_mm = from.position_mm + u * (a + u * (square + u * cube));
    const glm::dvec3 velocity_mm_per_s = (a + u * (2.0 * square + 3.0 * u * cube)) / span_s;
    Pose pose{.position_mm = curve_mm,
              .velocity_mm_per_s = velocity_mm_per_s,
              .turn = glm::slerp(from.turn, to.turn, u)};
    const double squared = glm::dot(way, way);
    const double along = squared > 0.0 ? glm::dot(curve_mm - from.position_mm, way) / squared : 0.0;
    const glm::dvec3 on_line_mm = from.position_mm + std::clamp(along, 0.0, 1.0) * way;
    if (glm::distance(curve_mm, on_line_mm) > most_bulge_mm) {
        pose.position_mm = on_line_mm + shortened(curve_mm - on_line_mm, most_bulge_mm);
        const bool moves_along = along > 0.0 && along < 1.0;
        pose.velocity_mm_per_s =
            moves_along ? way * (glm::dot(velocity_mm_per_s, way) / squared) : glm::dvec3(0.0);
    }
    return pose;
}

std::optional<SampledMotion::Pose> SampledMotion::at(double now_s) noexcept {
    const double elapsed_s = std::max(0.0, now_s - at_s_);
    at_s_ = now_s;
    clock_fault_ = ClockFault::none;
    if (count_ == 0) return std::nullopt;
    const double silence_s = std::clamp(silent_periods * period_s_, least_silence_s, most_silence_s);
    // A loop that stood still itself does not play the missed samples.
    if (now_s - newest().arrival_s > silence_s || (plays_ && elapsed_s > silence_s)) begin_anew();
    if (count_ < 3) return std::nullopt;
    clock_fault_ = judge_clock();
    if (clock_fault_ != ClockFault::none) {
        plays_ = false;
        return std::nullopt;
    }

    delay_s_ = std::min(delay_periods * period_s_ + lateness_margin * lateness_s_, longest_delay_s);
    const double wanted_s = now_s - offset_s_ - delay_s_;
    const double last_s = nth(count_ - 2).stamp_s;  // the last with a neighbour on both sides
    if (!plays_) {
        played_s_ = std::clamp(wanted_s, nth(1).stamp_s, last_s);
        plays_ = true;
    }
    const double behind = (wanted_s - played_s_ - elapsed_s) / (in_time_periods * period_s_);
    const double rate = 1.0 + std::clamp(behind, -1.0, 1.0) * (catch_up - 1.0);
    const double before_s = played_s_;
    played_s_ = std::min(played_s_ + rate * elapsed_s, std::max(last_s, played_s_));
    if (std::min(wanted_s, last_s) - played_s_ > longest_behind_s) {
        gained_s_ = most_gain_s;
        clock_fault_ = ClockFault::ahead;
        plays_ = false;
        return std::nullopt;
    }

    while (count_ > 3 && nth(2).stamp_s <= played_s_) {
        first_ = (first_ + 1) % most_samples;
        --count_;
    }
    std::size_t i = 0;
    while (i + 2 < count_ - 1 && nth(i + 1).stamp_s <= played_s_) ++i;
    Pose pose = pose_between(i, played_s_);
    pose.velocity_mm_per_s *= elapsed_s > 0.0 ? (played_s_ - before_s) / elapsed_s : 1.0;
    return pose;
}

}  // namespace osteomill
