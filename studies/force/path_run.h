// Run of a model along a path, step by step, with its results and its time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "studies/force/force_series.h"
#include "studies/force/studied_model.h"

namespace osteomill::study {

/// Puts the burr down at the first position, starts the spindle there and goes on to each of the others in a
/// step of `step_s`; the series holds these steps.
ForceSeries run_path(StudiedModel& model, const glm::dvec3& spindle_axis, double step_s,
                     std::span<const glm::dvec3> positions_mm);

/// The same of several models, in turns, step by step: their times tell which is faster, whatever else the
/// machine does.
std::vector<ForceSeries> run_in_turns(std::span<const std::unique_ptr<StudiedModel>> models,
                                      const glm::dvec3& spindle_axis, double step_s,
                                      std::span<const glm::dvec3> positions_mm);

}  // namespace osteomill::study
