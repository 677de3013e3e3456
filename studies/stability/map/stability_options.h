// `osteomill_study stability` on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "studies/stability/map/stability_study.h"
#include "studies/stability/sites/site_study.h"

namespace osteomill::study {

struct StabilityCommand {
    StabilityStudyOptions run{};
    std::vector<std::filesystem::path> merge{};  ///< empty: run; else join these
    bool runs_sites = false;                     ///< in place of the map
    int motions_on_rails = 0;                    ///< not 0: these in place of the map
    bool varies_encoders = false;                ///< in place of the map
    bool varies_springs = false;                 ///< likewise
    bool varies_frequency = false;               ///< in place of the map
    SiteStudyOptions sites{};                    ///< without what the map's options say
};

/// The subcommand, which fills in `command`; both outlive parsing.
CLI::App* add_stability(CLI::App& app, StabilityCommand& command);

}  // namespace osteomill::study
