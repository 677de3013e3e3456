// The force on the hand, over the session and while each tissue is cut.
//
// A frame that takes bone is a frame of the tissue of which it takes most (the lower label of two equals).
#pragma once

#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

struct ForceOfTissue {
    std::string tissue;
    double time_s = 0.0;
    double mean_n = 0.0;       ///< over time
    double p95_n = 0.0;        ///< of the samples
    double peak_n = 0.0;       ///< of the samples
    double impulse_n_s = 0.0;  ///< of the magnitude
};

struct ForceMetrics {
    double peak_n = 0.0;      ///< of every haptic tick, where the recording says it; else of the samples
    ForceOfTissue cutting{};  ///< all frames that take bone
    std::vector<ForceOfTissue> by_tissue{};  ///< only of those cut; ascending labels
};

ForceMetrics force_metrics(const SessionTrace& trace);

}  // namespace osteomill
