#include "studies/polishing/polishing_options.h"

namespace osteomill::study {

CLI::App* add_polishing(CLI::App& app, PolishingStudyOptions& options) {
    options.out = "study/polishing";
    CLI::App* polishing =
        app.add_subcommand("polishing", "the published polishing experiment: its figures and its claims");
    polishing->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    polishing->add_flag("--edge-forces", options.has_edge_forces,
                        "burrs whose edges rub, as in cortical bone; without, the published law");
    polishing->add_flag("--quick", options.quick, "fewer runs: under half a minute");
    return polishing;
}

}  // namespace osteomill::study
