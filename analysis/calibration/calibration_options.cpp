#include "analysis/calibration/calibration_options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "analysis/calibration/calibration_study.h"
#include "common/program/option_checks.h"

namespace osteomill::study {

namespace {

/// What was requested: a fit of a table, or which runs to make.
struct CalibrationCommand {
    std::filesystem::path data;
    std::filesystem::path out = "study/calibration";
    bool designs = false;
    DesignOptions design{};
};

void add_list(CLI::App& app, CLI::Option* design, const std::string& name, std::vector<double>& values,
              double low, double high, const std::string& what) {
    app.add_option(name, values, what + ", separated by commas")
        ->delimiter(',')
        ->check(within(low, high))
        ->capture_default_str()
        ->needs(design);
}

void add_design(CLI::App& app, CLI::Option* design, DesignOptions& options) {
    RunLattice& lattice = options.lattice;
    add_list(app, design, "--diameters-mm", lattice.diameters_mm, 0.2, 20.0, "burrs at hand");
    add_list(app, design, "--feeds-mm-per-s", lattice.feeds_mm_per_s, 0.001, 1000.0, "feeds that can be set");
    add_list(app, design, "--rpm", lattice.rpm, 100.0, 500'000.0, "spindle speeds that can be set");
    add_list(app, design, "--depths-mm", lattice.depths_mm, 0.001, 10.0,
             "depths that can be set; none is taken that is deeper than a burr's radius");
    add_list(app, design, "--tilts-deg", lattice.tilts_deg, 0.0, 85.0, "tilts of the spindle from upright");
    add_list(app, design, "--tilt-directions-deg", lattice.tilt_directions_deg, -360.0, 360.0,
             "where the shank leans: 0 ahead along the feed, 90 to the left of it");
    app.add_option("--edges", lattice.edges, "of the burrs")
        ->check(CLI::Range(1, 64))
        ->capture_default_str()
        ->needs(design);
    const std::map<std::string, SpindleSense> senses{{"clockwise", SpindleSense::clockwise},
                                                     {"counter-clockwise", SpindleSense::counter_clockwise}};
    app.add_option("--turns", lattice.turns, "clockwise or counter-clockwise, seen from the handpiece")
        ->transform(CLI::CheckedTransformer(senses))
        ->default_str("clockwise")
        ->needs(design);
    app.add_option("--runs", options.runs, "how many to choose")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str()
        ->needs(design);
    app.add_option("--material", options.material, "for the column of that name; no comma")
        ->check([](const std::string& name) {
            return name.find(',') == std::string::npos ? std::string()
                                                       : "a name with a comma parts its column";
        })
        ->capture_default_str()
        ->needs(design);
    app.add_option("--spread-n", options.spread_n,
                   "standard deviation of a mean force, for which the intervals to expect are printed")
        ->check(within(1e-6, 100.0))
        ->capture_default_str()
        ->needs(design);
    app.add_option("--seed", options.seed, "of the designs from which the search starts")
        ->capture_default_str()
        ->needs(design);
}

}  // namespace

StudyCommand add_calibration(CLI::App& app) {
    const auto shared = std::make_shared<CalibrationCommand>();
    CalibrationCommand& command = *shared;
    CLI::App* calibrate = app.add_subcommand(
        "calibrate",
        "the six coefficients of the milling law from forces on a dynamometer; or which runs to make");
    CLI::Option* data =
        calibrate->add_option("data", command.data, "table of runs (CSV): docs/calibration.md");
    add_out(*calibrate, command.out);
    CLI::Option* design =
        calibrate
            ->add_flag(
                "--design", command.designs,
                "choose the runs that tell most (D-optimal) and write OUT/design.csv to fill in; no table "
                "is read")
            ->excludes(data);
    add_design(*calibrate, design, command.design);
    calibrate->parse_complete_callback([shared] {
        if (shared->data.empty() && !shared->designs)
            throw CLI::RequiredError("a table of runs, or --design");
    });
    return {.subcommand = calibrate,
            .run =
                [shared](const StudySurroundings& surroundings) {
                    if (shared->designs) {
                        shared->design.out = shared->out;
                        return design_runs(shared->design, surroundings);
                    }
                    study::calibrate({.data = shared->data, .out = shared->out}, surroundings);
                },
            .writes = {"calibration.json", "calibration_*.svg", "residuals.csv", "scene.toml"}};
}

}  // namespace osteomill::study
