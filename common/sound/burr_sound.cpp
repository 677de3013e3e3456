#include "common/sound/burr_sound.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace osteomill {

namespace {

constexpr double most_rev_per_s = 10'000.0;
constexpr double most_force_n = 1000.0;
constexpr double least_stiffness = 0.01;
constexpr double most_stiffness = 10.0;

double usable(double value, double low, double high) noexcept {
    return std::isfinite(value) ? std::clamp(value, low, high) : low;
}

}  // namespace

SoundCue cue_of(const ToolState& tool, const Burr& burr) noexcept {
    SoundCue cue{.edges = std::max(1, burr.edges)};
    if (!tool.spindle_on) return cue;
    const double in_air_rev_per_s = usable(spindle_rpm(tool, burr) / 60.0, 0.0, most_rev_per_s);
    cue.rev_per_s = in_air_rev_per_s;
    if (!tool.cut) return cue;
    cue.force_n = usable(tool.cut->force_n, 0.0, most_force_n);
    cue.tooth_ripple_n = usable(tool.cut->tooth_ripple_n, 0.0, most_force_n);
    cue.relative_stiffness = usable(tool.cut->relative_stiffness, least_stiffness, most_stiffness);
    if (!tool.cut->loaded_rpm || !(in_air_rev_per_s > 0.0)) return cue;
    cue.rev_per_s = usable(*tool.cut->loaded_rpm / 60.0, 0.0, in_air_rev_per_s);
    cue.strain = 1.0 - cue.rev_per_s / in_air_rev_per_s;
    return cue;
}

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double sample_s = 1.0 / BurrSound::rate_hz;

// How fast things follow.
constexpr double runs_up_s = 0.1;
constexpr double coasts_s = 0.2;
constexpr double follows_s = 0.025;
constexpr double flutters_s = 0.02;
/// Slower is taken to stand. It is inaudible by then, see audible_share().
constexpr double standing_rev_per_s = 0.5;
constexpr double inaudible_strain = 1e-3;

// Loudness.
constexpr double faint_force_n = 0.05;
constexpr double loud_force_n = 10.0;
constexpr double tooth_level = 0.7;
constexpr double air_tooth_level = 0.015;
constexpr double whine_level = 0.025;
constexpr double grain_level = 0.35;
constexpr double growl_level = 0.12;
constexpr double run_out_beat = 0.3;
constexpr double flutter_share = 1.5;
/// The least share of the tooth note, even if the force is even or its model has no edges: burrs are not that
/// even.
constexpr double even_share = 0.4;
/// A load of a twentieth halves the whine.
constexpr double drowns = 20.0;

// Pitch.
constexpr double highest_full_hz = 17'000.0;
constexpr double highest_hz = 20'000.0;
constexpr int most_harmonics = 24;
constexpr double most_fall = 0.85;
/// Above it notes are turned down, by 3 dB an octave.
constexpr double keen_hz = 1000.0;
constexpr double growl_hz = 100.0;
/// Band of the grain in bone of relative stiffness 1, and how it follows the stiffness.
constexpr double cortical_grain_hz = 2200.0;
constexpr double grain_power = 0.6;
constexpr double least_grain_hz = 300.0;
constexpr double most_grain_hz = 9000.0;
constexpr double grain_damping = 1.2;  // 1/Q
/// The band need not be tuned at every sample.
constexpr int tuning_samples = 16;

double loudness(double force_n) noexcept {
    return std::min(1.0, std::log1p(force_n / faint_force_n) / std::log1p(loud_force_n / faint_force_n));
}

/// How much of a note is let through, by its pitch.
double pass(double hz) noexcept {
    const double below_top = std::clamp((highest_hz - hz) / (highest_hz - highest_full_hz), 0.0, 1.0);
    return below_top * std::min(1.0, std::sqrt(keen_hz / std::max(hz, 1.0)));
}

/// A spindle that hardly turns is hardly heard.
double audible_share(double rev_per_s) noexcept {
    const double slow_rev_per_s = 30.0;
    const double share = rev_per_s / (rev_per_s + slow_rev_per_s);
    return share * share;
}

double share_of(double time_s) noexcept {
    return sample_s / (time_s + sample_s);
}

double advanced(double turned, double hz) noexcept {
    const double next = turned + hz * sample_s;
    return next - std::floor(next);
}

}  // namespace

void BurrSound::Band::tune(double middle_hz) noexcept {
    g_ = std::tan(std::numbers::pi * middle_hz * sample_s);
}

double BurrSound::Band::pass(double in) noexcept {
    const double high = (in - (grain_damping + g_) * a_ - b_) / (1.0 + g_ * (g_ + grain_damping));
    const double band = g_ * high + a_;
    const double low = g_ * band + b_;
    a_ = band + g_ * high;
    b_ = low + g_ * band;
    return grain_damping * band;
}

void BurrSound::hear(const SoundCue& cue) noexcept {
    cue_ = cue;
    wanted_ = heard_of(cue);
    unheard_s_ = 0.0;
}

BurrSound::Heard BurrSound::heard_of(const SoundCue& cue) const noexcept {
    // If nothing is cut, the last cut fades with the colour that it had.
    if (!(cue.force_n > 0.0))
        return {.fall = wanted_.fall, .strain = cue.strain, .grain_hz = wanted_.grain_hz};
    const double load = loudness(cue.force_n);
    const double fall = std::min(most_fall, 0.5 * cue.tooth_ripple_n / cue.force_n);
    return {.load = load,
            .tooth = load * (even_share + (1.0 - even_share) * fall),
            .fall = fall,
            .strain = cue.strain,
            .grain_hz = std::clamp(cortical_grain_hz * std::pow(cue.relative_stiffness, grain_power),
                                   least_grain_hz, most_grain_hz)};
}

void BurrSound::follow() noexcept {
    unheard_s_ += sample_s;
    if (unheard_s_ > patience_s) hear({.edges = cue_.edges});
    rev_per_s_ += share_of(is_wanted() ? runs_up_s : coasts_s) * (cue_.rev_per_s - rev_per_s_);
    const double share = share_of(follows_s);
    heard_.load += share * (wanted_.load - heard_.load);
    heard_.tooth += share * (wanted_.tooth - heard_.tooth);
    heard_.fall += share * (wanted_.fall - heard_.fall);
    heard_.strain += share * (wanted_.strain - heard_.strain);
    heard_.grain_hz += share * (wanted_.grain_hz - heard_.grain_hz);
    flutter_ += share_of(flutters_s) * (white() - flutter_);
}

bool BurrSound::has_come_to_rest() const noexcept {
    return !is_wanted() && rev_per_s_ < standing_rev_per_s && heard_.strain < inaudible_strain;
}

void BurrSound::turn() noexcept {
    turned_rev_ = advanced(turned_rev_, rev_per_s_);
    tooth_turned_ = advanced(tooth_turned_, cue_.edges * rev_per_s_);
    growl_turned_ = advanced(growl_turned_, growl_hz);
    if (--samples_to_tuning_ > 0) return;
    samples_to_tuning_ = tuning_samples;
    grain_.tune(heard_.grain_hz);
}

double BurrSound::tooth_note() const noexcept {
    const double note_hz = cue_.edges * rev_per_s_;
    const double angle = two_pi * tooth_turned_;
    const double twice_cosine = 2.0 * std::cos(angle);
    double before = 0.0;
    double sine = std::sin(angle);
    double weight = 1.0;
    double sum = 0.0;
    for (int k = 1; k <= most_harmonics && k * note_hz < highest_hz && weight > 1e-3; ++k) {
        sum += weight / std::sqrt(k) * pass(k * note_hz) * sine;
        weight *= heard_.fall;
        before = std::exchange(sine, twice_cosine * sine - before);
    }
    return sum;
}

double BurrSound::white() noexcept {
    // xorshift (Marsaglia 2003).
    noise_ ^= noise_ << 13;
    noise_ ^= noise_ >> 17;
    noise_ ^= noise_ << 5;
    return static_cast<double>(noise_) / 2147483648.0 - 1.0;
}

double BurrSound::next_sample() noexcept {
    follow();
    turn();
    const double angle = two_pi * turned_rev_;
    const double beat = 1.0 + run_out_beat * std::sin(angle);
    const double uneven = 1.0 + flutter_share * flutter_;
    const double tooth = (air_tooth_level + tooth_level * heard_.tooth * uneven) * beat * tooth_note();
    const double whine =
        whine_level / (1.0 + drowns * heard_.load) *
        (std::sin(angle) * pass(rev_per_s_) + 0.4 * std::sin(2.0 * angle) * pass(2.0 * rev_per_s_));
    const double grain = grain_level * heard_.load * uneven * grain_.pass(white());
    const double turning = audible_share(rev_per_s_) * (tooth + whine + grain);
    const double growl = growl_level * heard_.strain * heard_.strain * std::sin(two_pi * growl_turned_);
    return std::tanh(turning + growl);
}

void BurrSound::render(std::span<float> samples) noexcept {
    for (float& sample : samples) {
        if (has_come_to_rest()) {
            // Every run-up from rest sounds alike.
            const SoundCue cue = cue_;
            *this = BurrSound();
            cue_ = cue;
            sample = 0.0f;
        } else {
            sample = static_cast<float>(next_sample());
        }
    }
}

}  // namespace osteomill
