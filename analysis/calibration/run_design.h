// The runs that tell most about the six coefficients: a D-optimal design (largest determinant of the
// information matrix, smallest volume of the coefficients' joint confidence region), found by exchange
// (Fedorov 1972 in the form of Cook and Nachtsheim 1980) over a lattice of settings that the lab can give.
//
// The mean force is linear in the coefficients, so the design does not depend on their values. All forces
// count as equally well known: noise and drift of a dynamometer hardly depend on the force. A setting is
// taken once; a lab repeats it to get its spread.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "analysis/calibration/coefficient_fit.h"

namespace osteomill::study {

/// What the lab can set; every combination is a candidate but those deeper than the burr's radius.
struct RunLattice {
    std::vector<double> diameters_mm{2.0, 4.0};
    std::vector<double> feeds_mm_per_s{1.0, 4.0, 16.0};
    std::vector<double> rpm{10'000.0, 20'000.0, 40'000.0};
    std::vector<double> depths_mm{0.2, 0.5, 1.0};
    std::vector<double> tilts_deg{0.0, 30.0, 45.0};
    std::vector<double> tilt_directions_deg{0.0, 90.0, 180.0, 270.0};
    int edges = 8;
    SpindleSense turns = SpindleSense::clockwise;
};

struct Candidate {
    RunSetting setting;
    RunRegressors regressors;
};

std::vector<Candidate> candidates_of(const RunLattice& lattice);

/// Settings and what they tell: of forces that are all known to 1 N.
struct RunDesign {
    std::vector<RunSetting> settings;
    double determinant = 0.0;  ///< of the information matrix
    double condition = 0.0;    ///< see largest_condition
    Coefficients
        uncertainty;  ///< standard, of each coefficient for each N of spread; infinite where it is lost
};

/// The best of `starts` exchanges from random designs. Throws std::runtime_error in one line where there are
/// fewer candidates than runs, fewer than three runs, or no design tells all coefficients apart.
RunDesign optimal_design(const std::vector<Candidate>& candidates, int runs, std::uint64_t seed,
                         int starts = 8);

/// The obvious choice: the middle of each list, then one list after the other through its other values; from
/// the start again until there are enough runs. A tilt is varied in all its directions.
RunDesign one_factor_at_a_time(const RunLattice& lattice, int runs);

/// How many runs of `other` tell as much as one of `design`: the ratio of the determinants to the power of
/// 1/6. Infinite where `other` does not tell the coefficients apart.
double efficiency(const RunDesign& design, const RunDesign& other);

}  // namespace osteomill::study
