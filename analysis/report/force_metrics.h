// The force on the hand, over the session, while each tissue is cut and while each burr cuts.
//
// A frame that takes bone is a frame of the tissue of which it takes most (the lower label of two equals).
#pragma once

#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

/// While one tissue was cut, or one burr cut.
struct ForceOf {
    std::string name;
    double time_s = 0.0;
    double mean_n = 0.0;       ///< over time
    double p95_n = 0.0;        ///< of ticks, where the recording holds them; else of the frames
    double impulse_n_s = 0.0;  ///< of the magnitude
};

struct ForceMetrics {
    double peak_n = 0.0;  ///< of every haptic tick, where the recording says it; else of the samples
    ForceOf cutting{};    ///< all frames that take bone
    std::vector<ForceOf> by_tissue{};  ///< only of those cut; ascending labels
    std::vector<ForceOf> by_burr{};    ///< only of those that cut; as the scene lists them
};

ForceMetrics force_metrics(const SessionTrace& trace);

}  // namespace osteomill
