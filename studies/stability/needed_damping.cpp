#include "studies/stability/needed_damping.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace osteomill::study {

double needed_damping_n_s_per_m(const ModelForce& model, const LinearHold& hold, double tick_s,
                                double angle) {
    if (hold.ticks_per_sample() != 1)
        throw std::invalid_argument("needed damping: the model must sample at every tick");
    const std::complex<double> one_tick_ago = std::polar(1.0, -angle);
    std::complex<double> weight = 0.0;
    std::complex<double> delay = 1.0;
    for (const double w : hold.weights.front()) {
        weight += w * delay;
        delay *= one_tick_ago;
    }
    const std::complex<double> resistance =
        weight * (model.stiffness_n_per_m + model.damping_n_s_per_m / tick_s * (1.0 - one_tick_ago));
    return 0.5 * tick_s / (1.0 - std::cos(angle)) * ((1.0 - one_tick_ago) * resistance).real();
}

WorstFrequency worst_frequency(const ModelForce& model, const LinearHold& hold, double tick_s) {
    constexpr int frequencies = 1000;
    WorstFrequency worst{.needed_damping_n_s_per_m = -std::numeric_limits<double>::infinity()};
    for (int i = 1; i <= frequencies; ++i) {
        const double angle = std::numbers::pi * i / frequencies;
        const double needed = needed_damping_n_s_per_m(model, hold, tick_s, angle);
        if (needed > worst.needed_damping_n_s_per_m) worst = {angle, needed};
    }
    return worst;
}

}  // namespace osteomill::study
