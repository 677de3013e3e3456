// The study of the bridge: what the way to an arm in another process costs, over a Unix socket, over UDP
// within this machine, and between two network namespaces; each beside a bare echo, in one run.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study bridge`: writes bridge.json and says what it found. Namespaces, which only root may make,
/// are left out with a line that says so.
StudyCommand add_bridge(CLI::App& app);

}  // namespace osteomill::study
