#include "haptic_server/device/tracker/sampled_motion.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

namespace {

constexpr double drift_s_per_s = 1e-3;
constexpr double lateness_memory_s = 20.0;
/// A sample that is a little later than any was does not hold playback up.
constexpr double lateness_margin = 1.1;
/// Stamps that step by more than this were set, not measured.
constexpr double longest_step_s = 1.0;
constexpr double silent_periods = 5.0;
constexpr double delay_periods = 2.0;
/// Playback that is off by so much of a period is brought back at the full rate.
constexpr double in_time_periods = 0.5;

}  // namespace

void SampledMotion::begin_anew() noexcept {
    count_ = 0;
    differences_ = 0;
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
    offset_s_ = std::min(apart_s, offset_s_ + drift_s_per_s * since_last_s);
    lateness_s_ = std::max(apart_s - offset_s_, lateness_s_ * std::exp(-since_last_s / lateness_memory_s));
}

void SampledMotion::take(Sample sample) noexcept {
    if (sample.stamp_s == 0.0) {
        sample.stamp_s = sample.arrival_s;
        // Samples that a link held up and gave at once were not measured at once.
        if (count_ > 0 && sample.arrival_s - newest().arrival_s < longest_step_s)
            sample.stamp_s = std::max(sample.stamp_s, newest().stamp_s + 0.5 * period_s_);
    }
    if (count_ > 0) {
        const double step_s = sample.stamp_s - newest().stamp_s;
        const double waited_s = sample.arrival_s - newest().arrival_s;
        if (std::abs(step_s - waited_s) > longest_step_s || waited_s > longest_step_s) {
            begin_anew();
        } else if (step_s <= 0.0) {
            return;
        } else {
            learn_period(step_s);
            learn_lateness(sample, waited_s);
        }
    }
    if (count_ == 0) {
        offset_s_ = sample.arrival_s - sample.stamp_s;
        lateness_s_ = 0.0;
    }
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
    if (i == 0) return chord(0);
    const double before_s = nth(i).stamp_s - nth(i - 1).stamp_s;
    const double after_s = nth(i + 1).stamp_s - nth(i).stamp_s;
    return (after_s * chord(i - 1) + before_s * chord(i)) / (before_s + after_s);
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
    return {.position_mm = from.position_mm + u * (a + u * (square + u * cube)),
            .velocity_mm_per_s = (a + u * (2.0 * square + 3.0 * u * cube)) / span_s,
            .turn = glm::slerp(from.turn, to.turn, u)};
}

std::optional<SampledMotion::Pose> SampledMotion::at(double now_s) noexcept {
    const double elapsed_s = std::max(0.0, now_s - at_s_);
    at_s_ = now_s;
    if (count_ == 0) return std::nullopt;
    const double silence_s = std::clamp(silent_periods * period_s_, least_silence_s, most_silence_s);
    if (now_s - newest().arrival_s > silence_s) begin_anew();
    if (count_ < 3) return std::nullopt;

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
