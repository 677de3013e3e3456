#include "common/sound/warning_tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/sound/burr_sound.h"

namespace osteomill {

namespace {

constexpr double step_s = 1.0 / BurrSound::rate_hz;
constexpr double edge_s = 0.01;
/// Amplitudes of the fundamental and its harmonics; their sum is 1.
constexpr std::array parts{0.4, 0.25, 0.15, 0.12, 0.08};

/// The loudness of a pulse that began so long ago, 0 to 1.
double envelope(double since_s) {
    if (since_s >= WarningTone::pulse_s) return 0.0;
    const double to_end_s = std::min(since_s, WarningTone::pulse_s - since_s);
    return 0.5 - 0.5 * std::cos(std::numbers::pi * std::min(1.0, to_end_s / edge_s));
}

double tone(double since_s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        sum += parts[i] * std::sin(2.0 * std::numbers::pi * WarningTone::fundamental_hz *
                                   static_cast<double>(i + 1) * since_s);
    return sum;
}

}  // namespace

void WarningTone::warn(StructureWarning warning) noexcept {
    warning_ = warning;
    unheard_s_ = 0.0;
}

void WarningTone::add_to(std::span<float> samples) noexcept {
    for (float& sample : samples) {
        if ((unheard_s_ += step_s) > patience_s) warning_ = StructureWarning::none;
        if (is_silent()) continue;
        const double added = loudest * envelope(in_period_s_) * tone(in_period_s_);
        sample = std::clamp(sample + static_cast<float>(added), -1.0f, 1.0f);
        in_period_s_ += step_s;
        const double period_s = warning_ == StructureWarning::touch  ? touch_period_s
                                : warning_ == StructureWarning::near ? near_period_s
                                                                     : pulse_s;
        if (in_period_s_ >= period_s) in_period_s_ = 0.0;
    }
}

}  // namespace osteomill
