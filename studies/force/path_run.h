// Run of a model along a path, step by step, with its results and its time.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "studies/force/studied_model.h"

namespace osteomill::study {

// Series of forces of a run, step by step, and the few numbers that say how good it was.

/// One entry a step.
struct ForceSeries {
    double step_s = 0.0;
    std::vector<glm::dvec3> force_n{};
    std::vector<double> removed_mm3{};
    std::vector<double> step_us{};  ///< time that the step took
};

/// Zero for an empty series.
glm::dvec3 mean_force_n(const ForceSeries& series);
double removal_mm3_per_s(const ForceSeries& series);

/// |value - reference| / |reference|; infinite if only the reference is zero, 0 if both are.
double relative_error(const glm::dvec3& value, const glm::dvec3& reference);

/// |F - mean| over |mean|, F being the mean force of each whole `window_s` (of each step if a step is
/// longer): the variation for a hand that follows no faster than that. None for a mean of zero.
std::vector<double> deviations(const ForceSeries& series, double window_s = 0.01);

/// Their root mean square; 0 for none.
double ripple(const ForceSeries& series, double window_s = 0.01);

/// The largest |F| of a step over |mean|; 0 for a mean of zero.
double largest_step(const ForceSeries& series);

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
