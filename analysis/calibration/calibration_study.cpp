#include "analysis/calibration/calibration_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "analysis/calibration/calibration_report.h"
#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"

namespace osteomill::study {

namespace {

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

void fit(MaterialCalibration& calibration, const std::filesystem::path& data) {
    calibration.input = fit_input(calibration.runs);
    std::vector<RunSetting> settings;
    for (const MeasuredRun& run : calibration.runs) settings.push_back(run.setting);
    try {
        refuse_one_feed(settings);
        calibration.fit = fit_coefficients(calibration.input);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(
            fmt::format("{}: material '{}': {}", data.string(), calibration.material, error.what()));
    }
    calibration.predicted_n = predictions_without_each_run(calibration.input);
}

void say(const MaterialCalibration& calibration, std::ostream& said) {
    const CoefficientFit& fit = calibration.fit;
    said << fmt::format("{}: {} runs, reduced chi^2 {:.2f}, condition {:.1f}\n", calibration.material,
                        calibration.runs.size(), fit.chi_squared / fit.degrees_of_freedom, fit.condition);
    for (Eigen::Index i = 0; i < coefficient_count; ++i) {
        const CoefficientName& name = coefficient_names[static_cast<std::size_t>(i)];
        said << fmt::format("  {:<5}{:10.4g} +- {:<9.2g} {}\n", name.symbol, fit.value(i), fit.half_width(i),
                            name.unit);
    }
    const CrossValidation validation = cross_validation_of(calibration);
    if (validation.runs > 0)
        said << fmt::format("  a run is predicted by the others to {:.3g} N rms ({:.2f} spreads)\n",
                            validation.rms_n, validation.rms_in_spreads);
    for (const std::string& warning : warnings_of(calibration)) said << "  note: " << warning << '\n';
}

void say(const char* name, const RunDesign& design, double spread_n, std::ostream& said) {
    said << fmt::format("{:<26} determinant {:9.3g}, condition {:5.3g}, intervals", name, design.determinant,
                        design.condition);
    for (Eigen::Index i = 0; i < coefficient_count; ++i)
        said << fmt::format(" {} +- {:.2g}{}", coefficient_names[static_cast<std::size_t>(i)].symbol,
                            1.96 * spread_n * design.uncertainty(i), i + 1 < coefficient_count ? "," : "\n");
}

}  // namespace

void calibrate(const CalibrationOptions& options, const StudySurroundings& surroundings) {
    std::vector<MaterialCalibration> calibrations = by_material(read_runs(options.data));
    for (MaterialCalibration& calibration : calibrations) fit(calibration, options.data);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const MaterialCalibration& calibration : calibrations) {
        say(calibration, surroundings.said);
        json.push_back(json_of(calibration));
    }
    make_folder(options.out);
    write_json(json, options.out / "calibration.json");
    residuals_of(calibrations).write(options.out / "residuals.csv");
    write_text(scene_fragment(calibrations, options.data.filename().string()), options.out / "scene.toml");
    for (const char* chart : {"calibration_fit", "calibration_residuals"})
        draw_chart(chart_scripts(), chart, options.out);
    surroundings.said << fmt::format(
        "calibration.json, residuals.csv, scene.toml and charts (SVG) are in {}\n", options.out.string());
}

void design_runs(const DesignOptions& options, const StudySurroundings& surroundings) {
    const std::vector<Candidate> candidates = candidates_of(options.lattice);
    const RunDesign design = optimal_design(candidates, options.runs, options.seed);
    const RunDesign grid = one_factor_at_a_time(options.lattice, options.runs);
    const std::string table = table_to_fill_in(design.settings, options.material);
    make_folder(options.out);
    write_text(table, options.out / "design.csv");
    surroundings.said << table;
    surroundings.said << fmt::format("{} runs of {} candidates; 95 % intervals for spreads of {:g} N:\n",
                                     options.runs, candidates.size(), options.spread_n);
    say("these runs:", design, options.spread_n, surroundings.said);
    say("one factor at a time:", grid, options.spread_n, surroundings.said);
    const double ratio = efficiency(design, grid);
    surroundings.said << (std::isfinite(ratio)
                              ? fmt::format(
                                    "each of these runs tells as much as {:.2f} of the other choice\n", ratio)
                              : std::string("the other choice does not tell the coefficients apart\n"));
    surroundings.said << fmt::format("the table to fill in is {}\n", (options.out / "design.csv").string());
}

}  // namespace osteomill::study
