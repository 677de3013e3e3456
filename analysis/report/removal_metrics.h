// Bone removed, of which tissue and by which burr; undone bone does not count as removed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"
#include "analysis/report/strokes.h"

namespace osteomill {

struct NamedVolume {
    std::string name;
    double mm3 = 0.0;
};

struct RemovalMetrics {
    double removed_mm3 = 0.0;              ///< of the bone as it was, at the end
    double undone_mm3 = 0.0;               ///< milled and given back
    std::size_t undos = 0;                 ///< undo and reset that were carried out, whatever was redone
    std::vector<NamedVolume> by_tissue{};  ///< every tissue of the scene; bone without a label, if any
    std::vector<NamedVolume> by_burr{};    ///< the burrs that took any
};

RemovalMetrics removal_metrics(const SessionTrace& trace, std::span<const Stroke> strokes);

/// "bone" for 0 ("other bone" if a tissue has that name), "tissue 7" for a label without a name in the scene.
std::string tissue_name(const SessionInfo& session, std::uint8_t label);

}  // namespace osteomill
