// Weighted linear least squares of the six coefficients, with intervals and with reasons to refuse them.
//
// Each force is divided by its spread, so that chi^2 = sum ((measured - fitted) / spread)^2 is least. The
// spreads are standard deviations that the lab has measured, so the intervals are those of known variances
// (GUM: 1.96 standard uncertainties), not estimated again from a few residuals. Only where chi^2 is larger
// than one set of runs in twenty would make it by chance do the spreads not explain the scatter; then the
// uncertainties are multiplied by the Birge ratio, sqrt(chi^2 / degrees of freedom), which is an estimate
// from the residuals, and Student's t takes the place of 1.96.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/force_regressors.h"

namespace osteomill::study {

/// Forces of all runs, three rows a run: feed, across, up.
struct FitInput {
    Eigen::Matrix<double, Eigen::Dynamic, coefficient_count> regressors;
    Eigen::VectorXd force_n;
    Eigen::VectorXd spread_n;
};

using Coefficients = Eigen::Matrix<double, coefficient_count, 1>;

struct CoefficientFit {
    Coefficients value;        ///< as coefficient_names
    Coefficients half_width;   ///< of the 95 % interval
    Coefficients uncertainty;  ///< standard
    Eigen::Matrix<double, coefficient_count, coefficient_count> correlation;
    double chi_squared = 0.0;
    int degrees_of_freedom = 0;
    double probability = 0.0;  ///< of a chi^2 as large as that or larger by chance
    double widened_by = 1.0;   ///< the Birge ratio, or 1
    double condition = 0.0;    ///< of the scaled design, see largest_condition
};

/// Condition number of the design, its rows divided by the spreads and its columns by their lengths, above
/// which a fit is refused. Depths, run-out and the law itself are true to some 3 %; errors of the design grow
/// by up to this factor in the coefficients, and 30 turns 3 % into everything. It is also where Belsley, Kuh
/// and Welsch (1980) begin to call dependencies strong.
constexpr double largest_condition = 30.0;

/// How much the feed of a tooth must vary over the runs, largest over smallest. With one feed the law's
/// geometry alone parts chip forces from edge forces: K_t t and K_te differ by how t falls towards the flanks
/// of the slot, and a fit would take that on trust.
constexpr double least_variation_of_feed = 2.0;

/// Throws std::runtime_error in one line where the feed of a tooth varies less than that.
void refuse_one_feed(const std::vector<RunSetting>& settings);

/// The table as a fit wants it.
FitInput fit_input(const std::vector<MeasuredRun>& runs);

/// Condition number as above; infinite where a coefficient has no part in any force.
double scaled_condition(const FitInput& input);

/// Throws std::runtime_error in one line: for fewer than three runs (six forces leave nothing to check six
/// coefficients by), for a design that cannot tell coefficients apart (which), for an interval that stands
/// for more force than was measured anywhere (which).
CoefficientFit fit_coefficients(const FitInput& input);

/// Each run's force as predicted by a fit to all the others, N; nothing where the others cannot tell the
/// coefficients apart: that run alone carries one of them.
std::vector<std::optional<Eigen::Vector3d>> predictions_without_each_run(const FitInput& input);

}  // namespace osteomill::study
