// Cumulative-sum chart of a trainee's passes and failures against an acceptable rate of failure.
//
//     S_0 = 0,  S_k = S_(k-1) + (failed ? 1 : 0) - s
//
// with P = ln(p1 / p0), Q = ln((1 - p0) / (1 - p1)) and s = Q / (P + Q), p0 the acceptable and p1 the
// unacceptable rate of failure: Wald's sequential test. From one level on, a rise by h1 = ln((1 - b) / a) /
// (P + Q) says that failures are at p1, a fall by h0 = ln((1 - a) / b) / (P + Q) that they are at p0, with a
// and b the chances to say so wrongly. Bolsin and Colson, "The use of the Cusum technique in the assessment
// of trainee competence in new procedures", International Journal for Quality in Health Care 12 (2000).
#pragma once

#include <vector>

namespace osteomill {

struct CusumDesign {
    double acceptable_rate = 0.2;
    double unacceptable_rate = 0.4;
    double false_alarm = 0.1;    ///< a
    double false_comfort = 0.1;  ///< b

    double step() const;  ///< s
    double rise() const;  ///< h1
    double fall() const;  ///< h0
};

/// S_0 to S_n.
std::vector<double> cusum(const std::vector<bool>& has_passed, const CusumDesign& design = {});

}  // namespace osteomill
