#include "analysis/statistics/cusum.h"

#include <cmath>

namespace osteomill {

namespace {

double p_of(const CusumDesign& design) {
    return std::log(design.unacceptable_rate / design.acceptable_rate);
}

double q_of(const CusumDesign& design) {
    return std::log((1.0 - design.acceptable_rate) / (1.0 - design.unacceptable_rate));
}

}  // namespace

double CusumDesign::step() const {
    return q_of(*this) / (p_of(*this) + q_of(*this));
}

double CusumDesign::rise() const {
    return std::log((1.0 - false_comfort) / false_alarm) / (p_of(*this) + q_of(*this));
}

double CusumDesign::fall() const {
    return std::log((1.0 - false_alarm) / false_comfort) / (p_of(*this) + q_of(*this));
}

std::vector<double> cusum(const std::vector<bool>& has_passed, const CusumDesign& design) {
    std::vector<double> sums{0.0};
    for (const bool passed : has_passed) sums.push_back(sums.back() + (passed ? 0.0 : 1.0) - design.step());
    return sums;
}

}  // namespace osteomill
