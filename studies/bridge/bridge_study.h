// The study of the bridge: what the way to an arm in another process costs, over a Unix socket, over UDP
// within this machine, and between two network namespaces; each beside a bare echo, in one run.
#pragma once

#include <filesystem>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct BridgeStudyOptions {
    std::filesystem::path out = "study/bridge";
    double seconds = 20.0;  ///< a way
    bool quick = false;
};

/// Writes bridge.json into `options.out` and says what it found. Namespaces, which only root may make, are
/// left out with a line that says so. Throws std::runtime_error in one line.
void run_bridge_study(const BridgeStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
