// Mean force of a run as a linear function of the six coefficients of the mechanistic milling law.
//
// The law is that of simulation/cutting_force/reference_force.h (Lee and Altintas 1996): each piece ds of an
// edge takes chip forces, K_t K_r K_a times the chip's cross-section, and edge forces, K_te K_re K_ae times
// ds. A column here is the reference's mean force with one coefficient of 1 and the others 0.
#pragma once

#include <Eigen/Core>
#include <array>

#include "analysis/calibration/run_table.h"

namespace osteomill::study {

constexpr Eigen::Index coefficient_count = 6;

struct CoefficientName {
    const char* symbol;
    const char* unit;
};
constexpr std::array<CoefficientName, coefficient_count> coefficient_names{{{"K_t", "N/mm^2"},
                                                                            {"K_r", "N/mm^2"},
                                                                            {"K_a", "N/mm^2"},
                                                                            {"K_te", "N/mm"},
                                                                            {"K_re", "N/mm"},
                                                                            {"K_ae", "N/mm"}}};

/// Rows: feed, across, up, of the force on the burr; columns as coefficient_names.
using RunRegressors = Eigen::Matrix<double, 3, coefficient_count>;

/// Within 0.3 % of what a far finer quadrature gives (tested).
RunRegressors regressors_of(const RunSetting& setting);

/// The same for settings that differ from one another in feed and speed only as the law says: chip forces are
/// proportional to the feed of a revolution, edge forces do not know it. `geometry` are the regressors of
/// `from`.
RunRegressors at_other_feed(const RunRegressors& geometry, const RunSetting& from, double feed_mm_per_s,
                            double rpm);

}  // namespace osteomill::study
