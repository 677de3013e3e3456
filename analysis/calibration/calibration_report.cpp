#include "analysis/calibration/calibration_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

constexpr std::array axes{"feed", "across", "up"};

const CoefficientName& name_of(Eigen::Index coefficient) {
    return coefficient_names[static_cast<std::size_t>(coefficient)];
}

/// Numbers with as many digits as their intervals bear out, and one more.
std::string with_interval(const CoefficientFit& fit, Eigen::Index i) {
    const int decimals =
        std::clamp(1 - static_cast<int>(std::floor(std::log10(std::max(fit.half_width(i), 1e-6)))), 0, 6);
    return fmt::format("{} {:.{}f} ({:.{}f} to {:.{}f})", name_of(i).symbol, fit.value(i), decimals,
                       fit.value(i) - fit.half_width(i), decimals, fit.value(i) + fit.half_width(i),
                       decimals);
}

std::string intervals(const CoefficientFit& fit, Eigen::Index first) {
    return fmt::format("{}, {}, {} {}", with_interval(fit, first), with_interval(fit, first + 1),
                       with_interval(fit, first + 2), name_of(first).unit);
}

/// A text between the quotes of TOML, whatever is in it.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string accepted_values(const Coefficients& value, Eigen::Index first) {
    return fmt::format("[{:#.6g}, {:#.6g}, {:#.6g}]", std::max(0.0, value(first)),
                       std::max(0.0, value(first + 1)), std::max(0.0, value(first + 2)));
}

/// Diameters and edges of the burrs that cut the material, each once, in the order of the runs.
std::vector<RunSetting> burrs_of(const MaterialCalibration& calibration) {
    std::vector<RunSetting> burrs;
    for (const MeasuredRun& run : calibration.runs) {
        const auto is_same = [&](const RunSetting& burr) {
            return burr.diameter_mm == run.setting.diameter_mm && burr.edges == run.setting.edges &&
                   burr.turns == run.setting.turns;
        };
        if (std::none_of(burrs.begin(), burrs.end(), is_same)) burrs.push_back(run.setting);
    }
    return burrs;
}

std::string scene_of(const MaterialCalibration& c, const std::string& source) {
    std::string toml = fmt::format(
        "# {}: {} runs of {}, osteomill_study calibrate, 95 % intervals, chi^2 {:.3g} of {} degrees of "
        "freedom\n",
        c.material, c.runs.size(), source, c.fit.chi_squared, c.fit.degrees_of_freedom);
    toml += fmt::format("#   {}\n#   {}\n", intervals(c.fit, 0), intervals(c.fit, 3));
    for (Eigen::Index i = 0; i < coefficient_count; ++i)
        if (c.fit.value(i) < 0.0)
            toml += fmt::format("#   {} is below 0, which a scene refuses: 0 here\n", name_of(i).symbol);
    for (const RunSetting& burr : burrs_of(c)) {
        toml += fmt::format("[[burrs]]\nname = \"{:g} mm, {} edges, {}\"\ndiameter_mm = {:.2f}\nedges = {}\n",
                            burr.diameter_mm, burr.edges, escaped(c.material), burr.diameter_mm, burr.edges);
        if (burr.turns == SpindleSense::counter_clockwise) toml += "turns = \"counter-clockwise\"\n";
        toml += fmt::format("cutting_coefficients_n_per_mm2 = {} # K_t, K_r, K_a\n",
                            accepted_values(c.fit.value, 0));
        toml += fmt::format("edge_coefficients_n_per_mm = {} # K_te, K_re, K_ae\n\n",
                            accepted_values(c.fit.value, 3));
    }
    return toml;
}

}  // namespace

CrossValidation cross_validation_of(const MaterialCalibration& calibration) {
    CrossValidation found;
    double squares_n2 = 0.0;
    double squares_in_spreads = 0.0;
    for (std::size_t i = 0; i < calibration.runs.size(); ++i) {
        if (!calibration.predicted_n[i]) {
            ++found.indispensable;
            continue;
        }
        ++found.runs;
        for (int axis = 0; axis < 3; ++axis) {
            const double error_n = calibration.runs[i].force_n[axis] - (*calibration.predicted_n[i])(axis);
            squares_n2 += error_n * error_n;
            squares_in_spreads += std::pow(error_n / calibration.runs[i].spread_n[axis], 2);
        }
    }
    const double forces = std::max(1, 3 * found.runs);
    found.rms_n = std::sqrt(squares_n2 / forces);
    found.rms_in_spreads = std::sqrt(squares_in_spreads / forces);
    return found;
}

std::vector<std::string> warnings_of(const MaterialCalibration& calibration) {
    const CoefficientFit& fit = calibration.fit;
    std::vector<std::string> warnings;
    if (fit.widened_by > 1.0)
        warnings.push_back(fmt::format(
            "the forces scatter more than their spreads say (chi^2 {:.3g} of {} degrees of freedom): "
            "intervals are "
            "widened {:.2g} times; look for drift, run-out or a law that does not hold in the residuals",
            fit.chi_squared, fit.degrees_of_freedom, fit.widened_by));
    for (Eigen::Index i = 0; i < coefficient_count; ++i) {
        if (fit.value(i) + fit.half_width(i) < 0.0)
            warnings.push_back(
                fmt::format("{} is below 0 with its whole interval: check the signs of the axes, that the "
                            "force is the bone's "
                            "on the burr, and which way the burr turns",
                            name_of(i).symbol));
        else if (fit.value(i) - fit.half_width(i) <= 0.0)
            warnings.push_back(fmt::format("{} may be 0: its interval holds it", name_of(i).symbol));
    }
    for (std::size_t run = 0; run < calibration.runs.size(); ++run)
        if (!calibration.predicted_n[run])
            warnings.push_back(fmt::format(
                "without run {} coefficients cannot be told apart: it alone carries one; repeat it",
                calibration.runs[run].name));
    return warnings;
}

ordered_json json_of(const MaterialCalibration& calibration) {
    const CoefficientFit& fit = calibration.fit;
    const CrossValidation validation = cross_validation_of(calibration);
    ordered_json coefficients = ordered_json::array();
    ordered_json correlation = ordered_json::array();
    for (Eigen::Index i = 0; i < coefficient_count; ++i) {
        coefficients.push_back(
            {{"name", name_of(i).symbol},
             {"unit", name_of(i).unit},
             {"value", fit.value(i)},
             {"interval_95", {fit.value(i) - fit.half_width(i), fit.value(i) + fit.half_width(i)}},
             {"standard_uncertainty", fit.uncertainty(i)}});
        ordered_json row = ordered_json::array();
        for (Eigen::Index j = 0; j < coefficient_count; ++j) row.push_back(fit.correlation(i, j));
        correlation.push_back(row);
    }
    return {{"material", calibration.material},
            {"runs", calibration.runs.size()},
            {"coefficients", coefficients},
            {"correlation", correlation},
            {"chi_squared", fit.chi_squared},
            {"degrees_of_freedom", fit.degrees_of_freedom},
            {"reduced_chi_squared", fit.chi_squared / fit.degrees_of_freedom},
            {"probability", fit.probability},
            {"widened_by", fit.widened_by},
            {"condition", fit.condition},
            {"leave_one_run_out",
             {{"rms_n", validation.rms_n},
              {"rms_in_spreads", validation.rms_in_spreads},
              {"runs", validation.runs},
              {"indispensable_runs", validation.indispensable}}},
            {"warnings", warnings_of(calibration)}};
}

Table residuals_of(const std::vector<MaterialCalibration>& calibrations) {
    Table table({"run", "material", "material_number", "axis", "axis_number", "measured_n", "spread_n",
                 "fitted_n", "residual_in_spreads", "predicted_by_others_n"});
    for (std::size_t material = 0; material < calibrations.size(); ++material) {
        const MaterialCalibration& c = calibrations[material];
        const Eigen::VectorXd fitted_n = c.input.regressors * c.fit.value;
        for (std::size_t run = 0; run < c.runs.size(); ++run)
            for (int axis = 0; axis < 3; ++axis) {
                const double measured = c.runs[run].force_n[axis];
                const double fitted = fitted_n(3 * static_cast<Eigen::Index>(run) + axis);
                const double spread = c.runs[run].spread_n[axis];
                table.add({c.runs[run].name, c.material, material + 1, axes[static_cast<std::size_t>(axis)],
                           axis + 1, measured, spread, fitted, (measured - fitted) / spread,
                           c.predicted_n[run] ? nlohmann::ordered_json((*c.predicted_n[run])(axis))
                                              : nlohmann::ordered_json()});
            }
    }
    return table;
}

std::string scene_fragment(const std::vector<MaterialCalibration>& calibrations, const std::string& source) {
    std::string toml =
        "# To copy into a scene. The coefficients are of the bone that was milled, which is then relative\n"
        "# stiffness 1.\n\n";
    for (const MaterialCalibration& c : calibrations) toml += scene_of(c, source);
    return toml;
}

}  // namespace osteomill::study
