// Harm to each protected structure: how near the burr came, when and how long it touched, and how much of the
// structure is gone. nearness_metrics.h: how the trainee cuts near one; exposure_metrics.h: how much of one
// lies bare.
//
// A structure is where the recording says it is, or else where the bone has its tissue's label. Distances
// are from the burr's head, whatever its shape, to the structure, at the states of the recording
// (structure_watch.h): the very numbers of the live session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

struct StructureMetrics {
    std::string name;
    std::optional<double> nearest_mm{};  ///< 0 once touched; nothing: never within watched_mm(), or nowhere
    std::size_t touches = 0;             ///< spells in which the burr overlapped it or took of it
    std::optional<double> first_touch_s{};
    double touched_s = 0.0;        ///< in all
    double dose_mm3 = 0.0;         ///< bone of it that is gone at the end
    double undone_dose_mm3 = 0.0;  ///< that was milled and given back
    double entered_mm3 = 0.0;      ///< voxels of it, bone or not, that the burr's head entered
};

/// Metrics of every protected tissue of the scene.
std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace);

}  // namespace osteomill
