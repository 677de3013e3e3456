#include "studies/bridge/bridge_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "studies/bridge/bridge_study.h"

namespace osteomill::study {

StudyCommand add_bridge(CLI::App& app) {
    const auto shared = std::make_shared<BridgeStudyOptions>();
    BridgeStudyOptions& options = *shared;
    CLI::App* bridge = app.add_subcommand(
        "bridge", "the way to an arm behind the bridge and back, beside a bare echo of the same size");
    add_out(*bridge, options.out);
    bridge->add_option("--seconds", options.seconds, "that each way is measured")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    bridge->add_flag("--quick", options.quick, "two seconds each");
    return {
        .subcommand = bridge,
        .run = [shared](const StudySurroundings& surroundings) { run_bridge_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
