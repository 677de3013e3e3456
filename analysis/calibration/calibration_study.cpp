#include "analysis/calibration/calibration_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "analysis/calibration/calibration_report.h"
#include "analysis/output/cases/json_values.h"
#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"

template <int rows, int columns>
struct nlohmann::adl_serializer<Eigen::Matrix<double, rows, columns>> {
    using Matrix = Eigen::Matrix<double, rows, columns>;
    static void to_json(nlohmann::json& json, const Matrix& matrix) {
        json = std::vector<double>(matrix.data(), matrix.data() + matrix.size());
    }
    static void from_json(const nlohmann::json& json, Matrix& matrix) {
        matrix = Eigen::Map<const Matrix>(json.get<std::vector<double>>().data());
    }
};

namespace osteomill::study {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CoefficientFit, value, half_width, uncertainty, correlation, chi_squared,
                                   degrees_of_freedom, probability, widened_by, condition)

namespace {

/// What comes of a material's runs.
struct Fitted {
    CoefficientFit fit{};
    std::vector<std::optional<Eigen::Vector3d>> predicted_n{};
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Fitted, fit, predicted_n)

/// In the order in which the table names them.
std::vector<MaterialCalibration> by_material(std::vector<MeasuredRun> runs) {
    std::vector<MaterialCalibration> calibrations;
    for (MeasuredRun& run : runs) {
        auto found = std::find_if(calibrations.begin(), calibrations.end(),
                                  [&](const auto& c) { return c.material == run.material; });
        if (found == calibrations.end())
            found = calibrations.insert(calibrations.end(), MaterialCalibration{.material = run.material});
        found->runs.push_back(std::move(run));
    }
    return calibrations;
}

Fitted fit(const MaterialCalibration& calibration, const std::filesystem::path& data) {
    std::vector<RunSetting> settings;
    for (const MeasuredRun& run : calibration.runs) settings.push_back(run.setting);
    try {
        refuse_one_feed(settings);
        return {fit_coefficients(calibration.input), predictions_without_each_run(calibration.input)};
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(data.string() + ": " + error.what());
    }
}

std::string text_of(const MaterialCalibration& calibration) {
    std::string said;
    const CoefficientFit& fit = calibration.fit;
    said += fmt::format("{}: {} runs, reduced chi^2 {:.2f}, condition {:.1f}\n", calibration.material,
                        calibration.runs.size(), fit.chi_squared / fit.degrees_of_freedom, fit.condition);
    for (Eigen::Index i = 0; i < coefficient_count; ++i) {
        const CoefficientName& name = coefficient_names[static_cast<std::size_t>(i)];
        said += fmt::format("  {:<5}{:10.4g} +- {:<9.2g} {}\n", name.symbol, fit.value(i), fit.half_width(i),
                            name.unit);
    }
    const CrossValidation validation = cross_validation_of(calibration);
    if (validation.runs > 0)
        said += fmt::format("  a run is predicted by the others to {:.3g} N rms ({:.2f} spreads)\n",
                            validation.rms_n, validation.rms_in_spreads);
    for (const std::string& warning : warnings_of(calibration)) said += "  note: " + warning + '\n';
    return said;
}

std::string text_of(const char* name, const RunDesign& design, double spread_n) {
    std::string said = fmt::format("{:<26} determinant {:9.3g}, condition {:5.3g}, intervals", name,
                                   design.determinant, design.condition);
    for (Eigen::Index i = 0; i < coefficient_count; ++i)
        said += fmt::format(" {} +- {:.2g}{}", coefficient_names[static_cast<std::size_t>(i)].symbol,
                            1.96 * spread_n * design.uncertainty(i), i + 1 < coefficient_count ? "," : "\n");
    return said;
}

/// What a choice of runs comes to: the table to fill in, and a summary.
std::array<std::string, 2> designed(const DesignOptions& options) {
    const std::vector<Candidate> candidates = candidates_of(options.lattice);
    const RunDesign design = optimal_design(candidates, options.runs, options.seed);
    const RunDesign grid = one_factor_at_a_time(options.lattice, options.runs);
    const double ratio = efficiency(design, grid);
    return {table_to_fill_in(design.settings, options.material),
            fmt::format("{} runs of {} candidates; 95 % intervals for spreads of {:g} N:\n", options.runs,
                        candidates.size(), options.spread_n) +
                text_of("these runs:", design, options.spread_n) +
                text_of("one factor at a time:", grid, options.spread_n) +
                (std::isfinite(ratio)
                     ? fmt::format("each of these runs tells as much as {:.2f} of the other choice", ratio)
                     : std::string("the other choice does not tell the coefficients apart"))};
}

}  // namespace

void calibrate(const CalibrationOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    std::vector<MaterialCalibration> calibrations = by_material(read_runs(options.data));
    for (MaterialCalibration& calibration : calibrations) calibration.input = fit_input(calibration.runs);
    StudyRun run(options.out, surroundings);
    const auto planned = run.plan(
        calibrations, [](const MaterialCalibration& c) { return "material " + c.material; },
        [&](const MaterialCalibration& c) { return fit(c, options.data); });
    if (!run.perform()) return;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const std::vector<Fitted> fits = planned.outcomes();
    for (std::size_t i = 0; i < fits.size(); ++i) {
        calibrations[i].fit = fits[i].fit;
        calibrations[i].predicted_n = fits[i].predicted_n;
        surroundings.said << text_of(calibrations[i]);
        json.push_back(json_of(calibrations[i]));
    }
    run.write(json, "calibration");
    run.write(residuals_of(calibrations), "residuals");
    write_text(scene_fragment(calibrations, options.data.filename().string()), options.out / "scene.toml");
    run.draw({"calibration_fit", "calibration_residuals"});
    run.say("calibration.json, residuals.csv, scene.toml and charts (SVG) are in {}", options.out.string());
}

void design_runs(const DesignOptions& options, const StudySurroundings& surroundings) {
    StudyRun run(options.out, surroundings);
    const auto planned = run.plan(
        std::vector{options}, [](const DesignOptions&) { return "design"; }, designed);
    if (!run.perform()) return;
    const auto [table, summary] = planned.outcomes().front();
    write_text(table, options.out / "design.csv");
    surroundings.said << table;
    run.say("{}", summary);
    run.say("the table to fill in is {}", (options.out / "design.csv").string());
}

}  // namespace osteomill::study
