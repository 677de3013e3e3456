#include "studies/stability/linear_hold.h"

#include <stdexcept>

namespace osteomill::study {
namespace {

/// 1.5 `now` - 0.5 `before`, which reaches back as far as `now` or further.
LinearHold estimate(const LinearHold& now, const LinearHold& before) {
    LinearHold result = before;
    for (std::size_t tick = 0; tick < result.ticks_per_sample(); ++tick) {
        for (double& weight : result.weights[tick]) weight *= -0.5;
        for (std::size_t age = 0; age < now.forces_remembered(); ++age)
            result.weights[tick][age] += 1.5 * now.weights[tick][age];
    }
    return result;
}

}  // namespace

LinearHold held(const std::vector<double>& weights_by_age, std::size_t ticks_per_sample) {
    if (weights_by_age.empty()) throw std::invalid_argument("hold: at least one weight");
    if (ticks_per_sample == 0) throw std::invalid_argument("hold: at least one tick per sample");
    return {std::vector<std::vector<double>>(ticks_per_sample, weights_by_age)};
}

LinearHold zero_order_hold(std::size_t ticks_per_sample) {
    return held({1.0}, ticks_per_sample);
}

LinearHold one_sample_late(std::size_t ticks_per_sample) {
    return held({0.0, 1.0}, ticks_per_sample);
}

LinearHold interpolated(std::size_t ticks_per_sample) {
    LinearHold hold = held({0.0, 0.0}, ticks_per_sample);
    for (std::size_t tick = 0; tick < ticks_per_sample; ++tick) {
        const double share = static_cast<double>(tick + 1) / static_cast<double>(ticks_per_sample);
        hold.weights[tick] = {share, 1.0 - share};
    }
    return hold;
}

LinearHold sample_estimate_hold(std::size_t ticks_per_sample) {
    return of_estimates(zero_order_hold(ticks_per_sample));
}

LinearHold corrected_sample_estimate_hold(std::size_t ticks_per_sample) {
    return held({2.0, -1.5, 0.5}, ticks_per_sample);
}

LinearHold late_sample_estimate_hold(std::size_t ticks_per_sample) {
    return held({0.0, 2.5, -1.5}, ticks_per_sample);
}

LinearHold of_estimates(const LinearHold& hold) {
    return estimate(hold, late_by_ticks(hold, hold.ticks_per_sample()));
}

LinearHold then_estimated(const LinearHold& hold) {
    return estimate(hold, late_by_ticks(hold, 1));
}

LinearHold late_by_ticks(const LinearHold& hold, std::size_t ticks) {
    const std::size_t per_sample = hold.ticks_per_sample();
    const std::size_t most_periods = (ticks + per_sample - 1) / per_sample;
    LinearHold late = held(std::vector<double>(hold.forces_remembered() + most_periods, 0.0), per_sample);
    for (std::size_t tick = 0; tick < per_sample; ++tick) {
        // The tick whose force comes out now lies `periods` model periods back, at tick `source` of its
        // period.
        const std::size_t periods = tick >= ticks ? 0 : (ticks - tick + per_sample - 1) / per_sample;
        const std::size_t source = tick + periods * per_sample - ticks;
        for (std::size_t age = 0; age < hold.forces_remembered(); ++age)
            late.weights[tick][age + periods] = hold.weights[source][age];
    }
    return late;
}

}  // namespace osteomill::study
