#include "studies/polishing/polishing_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "studies/polishing/polishing_study.h"

namespace osteomill::study {

StudyCommand add_polishing(CLI::App& app) {
    const auto shared = std::make_shared<PolishingStudyOptions>();
    PolishingStudyOptions& options = *shared;
    options.out = "study/polishing";
    CLI::App* polishing = app.add_subcommand("polishing", "the published polishing experiment: its figures");
    add_out(*polishing, options.out);
    polishing->add_flag("--edge-forces", options.has_edge_forces,
                        "burrs whose edges rub, as in cortical bone; without, the published law");
    polishing->add_flag("--quick", options.quick, "fewer runs: under half a minute");
    return {polishing,
            [shared](const StudySurroundings& surroundings) { run_polishing_study(*shared, surroundings); },
            jobs_of_processors()};
}

}  // namespace osteomill::study
