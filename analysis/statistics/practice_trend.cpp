#include "analysis/statistics/practice_trend.h"

#include <cmath>
#include <map>

namespace osteomill {

namespace {

struct Sums {
    double n = 0.0;
    double log = 0.0;
    double value = 0.0;
};

}  // namespace

std::optional<PracticeTrend> practice_trend(std::span<const PracticeValue> values) {
    std::map<std::string, Sums> of_trainee;
    Sums all;
    for (const PracticeValue& one : values)
        for (Sums* sums : {&of_trainee[one.trainee], &all}) {
            sums->n += 1.0;
            sums->log += std::log(one.attempt);
            sums->value += one.value;
        }
    double product = 0.0;
    double squares = 0.0;
    PracticeTrend trend;
    for (const PracticeValue& one : values) {
        const Sums& own = of_trainee[one.trainee];
        const double log = std::log(one.attempt) - own.log / own.n;
        const double value = one.value - own.value / own.n;
        trend.spread_ += log * log;
        product += log * value;
        squares += value * value;
    }
    trend.n_ = all.n;
    trend.degrees_ = all.n - static_cast<double>(of_trainee.size()) - 1.0;
    if (!(trend.spread_ > 0.0) || trend.degrees_ < 1.0) return std::nullopt;
    trend.mean_log_ = all.log / all.n;
    trend.mean_value_ = all.value / all.n;
    trend.slope_ = product / trend.spread_;
    trend.variance_ = std::max(0.0, squares - trend.slope_ * product) / trend.degrees_;
    return trend;
}

Interval PracticeTrend::slope_interval() const {
    const double half = interval_errors(degrees_) * std::sqrt(variance_ / spread_);
    return {slope_ - half, slope_ + half};
}

double PracticeTrend::p() const {
    if (variance_ == 0.0) return slope_ == 0.0 ? 1.0 : 0.0;
    return two_sided_p(slope_ / std::sqrt(variance_ / spread_), degrees_);
}

double PracticeTrend::at(double attempt) const {
    return mean_value_ + slope_ * (std::log(attempt) - mean_log_);
}

Interval PracticeTrend::interval_at(double attempt) const {
    const double off = std::log(attempt) - mean_log_;
    const double half = interval_errors(degrees_) * std::sqrt(variance_ * (1.0 / n_ + off * off / spread_));
    return {at(attempt) - half, at(attempt) + half};
}

}  // namespace osteomill
