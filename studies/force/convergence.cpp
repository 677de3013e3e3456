#include "studies/force/convergence.h"

#include <fmt/format.h>

#include <cmath>

namespace osteomill::study {

namespace {

/// Mean over motions and over lattices that lie `places` ways, as shares of a voxel, so that coarse and fine
/// voxels are met at the same places.
double mean_error(const std::vector<StudiedMotion>& motions, double voxel_mm, int places,
                  const MakeModel& make_model) {
    double sum = 0.0;
    for (const StudiedMotion& motion : motions)
        for (int i = 0; i < places; ++i) {
            const double share = (i + 0.31) / places;
            const ForceSeries series = run_motion(
                motion,
                {.voxel_mm = voxel_mm,
                 .lattice_shift_mm = voxel_mm * glm::dvec3(share, std::fmod(2.62 * share, 1.0), 0.0)},
                make_model);
            sum += relative_error(mean_force_n(series), motion.reference_n);
        }
    return sum / static_cast<double>(motions.size()) / places;
}

/// The value at `at` of the power law of a slope through the points' centre of gravity.
double fitted(const std::vector<double>& x, const std::vector<double>& y, double slope, double at) {
    double log_ratio = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        log_ratio += (std::log(y[i]) - slope * std::log(x[i])) / static_cast<double>(x.size());
    return std::exp(log_ratio + slope * std::log(at));
}

struct Columns {
    std::vector<double> voxel_mm;
    std::vector<double> soft;
    std::vector<double> binary;
};

Columns columns_of(const std::vector<ConvergenceRow>& rows) {
    Columns columns;
    for (const ConvergenceRow& row : rows) {
        columns.voxel_mm.push_back(row.voxel_mm);
        columns.soft.push_back(row.soft_error);
        columns.binary.push_back(row.binary_error);
    }
    return columns;
}

}  // namespace

Convergence measure_convergence(const std::vector<StudiedMotion>& motions, bool quick,
                                const Progress& progress) {
    // They divide the 0.8 mm of the layer of "two layers": this is about how voxels are cut, not about where
    // a voxel's one stiffness puts the border of a layer.
    const std::vector<double> sizes_mm =
        quick ? std::vector{0.4, 0.2, 0.1}
              : std::vector{0.4, 0.8 / 3.0, 0.2, 0.16, 0.8 / 6.0, 0.1, 0.08, 0.05};
    const int places = quick ? 2 : 4;
    Convergence convergence;
    for (const double voxel_mm : sizes_mm) {
        convergence.rows.push_back(
            {.voxel_mm = voxel_mm,
             .soft_error = mean_error(motions, voxel_mm, places, voxel_model()),
             .binary_error =
                 mean_error(motions, voxel_mm, places, voxel_model({.coverage = VoxelCoverage::binary}))});
        progress(static_cast<double>(convergence.rows.size()) / static_cast<double>(sizes_mm.size()));
    }
    const Columns columns = columns_of(convergence.rows);
    convergence.soft_slope = log_log_slope(columns.voxel_mm, columns.soft);
    convergence.binary_slope = log_log_slope(columns.voxel_mm, columns.binary);
    return convergence;
}

std::string csv_of(const Convergence& convergence) {
    const Columns columns = columns_of(convergence.rows);
    std::string csv =
        "voxel_mm,soft_error_percent,binary_error_percent,soft_fit_percent,binary_fit_percent\n";
    for (const ConvergenceRow& row : convergence.rows)
        csv += fmt::format(
            "{:.4f},{:.5f},{:.5f},{:.5f},{:.5f}\n", row.voxel_mm, 100.0 * row.soft_error,
            100.0 * row.binary_error,
            100.0 * fitted(columns.voxel_mm, columns.soft, convergence.soft_slope, row.voxel_mm),
            100.0 * fitted(columns.voxel_mm, columns.binary, convergence.binary_slope, row.voxel_mm));
    return csv;
}

}  // namespace osteomill::study
