// How near the burr came to each protected structure, when it touched it, and how much of it went.
//
// A structure is what bears its tissue's label, as the recording has it: bone. The nearest approach is from
// the ball of the burr's diameter about the burr's centre to the centre of the structure's nearest voxel, 0
// where they overlap, over all frames; it is within a voxel of the distance between the surfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptic_server/report/session_trace.h"

namespace osteomill {

/// Contact that ends for less than this goes on.
inline constexpr double touch_gap_s = 0.5;

struct StructureMetrics {
    std::string name;
    std::optional<double> nearest_mm{};  ///< nothing where the bone has none of it
    std::size_t touches = 0;             ///< spells in which some of it was milled, undone or not
    std::optional<double> first_touch_s{};
    double dose_mm3 = 0.0;         ///< of it that is gone at the end
    double undone_dose_mm3 = 0.0;  ///< that was milled and given back
};

/// Of every protected tissue of the scene.
std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace);

}  // namespace osteomill
