// Bone removed, of which tissue and by which burr, and the force on the hand meanwhile; undone bone does
// not count as removed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"
#include "analysis/report/strokes.h"

namespace osteomill {

/// Bone removed, of which tissue and by which burr; undone bone does not count as removed.
struct NamedVolume {
    std::string name;
    double mm3 = 0.0;
};

struct RemovalMetrics {
    double removed_mm3 = 0.0;              ///< of the bone as it was, at the end
    double undone_mm3 = 0.0;               ///< milled and given back
    std::size_t undos = 0;                 ///< undo and reset of which something was not redone
    std::vector<NamedVolume> by_tissue{};  ///< every tissue of the scene; bone without a label, if any
    std::vector<NamedVolume> by_burr{};    ///< the burrs that took any
};

RemovalMetrics removal_metrics(const SessionTrace& trace, std::span<const Stroke> strokes);

/// "bone" for 0 ("other bone" if a tissue has that name), "tissue 7" for a label without a name in the scene.
std::string tissue_name(const SessionInfo& session, std::uint8_t label);

// The force on the hand, over the session, while each tissue is cut and while each burr cuts.
//
// A frame that takes bone is a frame of the tissue of which it takes most (the lower label of two equals).

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
