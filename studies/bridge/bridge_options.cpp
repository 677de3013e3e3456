#include "studies/bridge/bridge_options.h"

namespace osteomill::study {

CLI::App* add_bridge(CLI::App& app, BridgeStudyOptions& options) {
    CLI::App* bridge = app.add_subcommand(
        "bridge", "the way to an arm behind the bridge and back, beside a bare echo of the same size");
    bridge->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    bridge->add_option("--seconds", options.seconds, "that each way is measured")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    bridge->add_flag("--quick", options.quick, "two seconds each");
    return bridge;
}

}  // namespace osteomill::study
