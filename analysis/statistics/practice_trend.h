// Trend of a metric with practice: how it changes with the logarithm of the attempt, within trainees.
//
//     y_ij = a_i + b ln(n_ij) + e_ij
//
// Each trainee i has a level a_i; the slope b is common to all, so that differences between trainees are not
// taken for learning. Ordinary least squares; R: lm(y ~ trainee + log(n)). The line is that of the trainees
// at their mean level, each weighed by the number of attempts; its interval is that of this mean. Values may
// be zero, unlike in a power law of practice.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/statistics/mean_interval.h"

namespace osteomill {

struct PracticeValue {
    std::string trainee{};
    int attempt = 1;  ///< from 1
    double value = 0.0;
};

class PracticeTrend {
  public:
    double slope() const { return slope_; }  ///< change of the metric per factor e of attempts
    Interval slope_interval() const;
    double p() const;  ///< two-sided, of no trend
    double degrees() const { return degrees_; }
    double at(double attempt) const;
    Interval interval_at(double attempt) const;  ///< of the mean there

  private:
    friend std::optional<PracticeTrend> practice_trend(std::span<const PracticeValue> values);
    double n_ = 0.0;
    double degrees_ = 0.0;
    double mean_log_ = 0.0;
    double mean_value_ = 0.0;
    double spread_ = 0.0;  // sum of squares of ln(n) within trainees
    double slope_ = 0.0;
    double variance_ = 0.0;  // of e
};

/// Nothing where no trainee has two attempts, or the attempts leave no degree of freedom.
std::optional<PracticeTrend> practice_trend(std::span<const PracticeValue> values);

}  // namespace osteomill
