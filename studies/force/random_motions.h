// Steady motions drawn at random, and the accuracy of the voxel model over them: the check of what the
// documents promise, on motions that nothing was tuned to.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/cases/json_values.h"
#include "analysis/output/table.h"
#include "studies/force/steady_run.h"

namespace osteomill::study {

/// A motion of a burr of 1 to 5 mm, 4 to 12 edges, either sense of rotation, 5 000 to 80 000 rpm, its spindle
/// leaning by up to 70 degrees in any direction, at 0.2 to 60 mm/s, one voxel to the equator deep, over a
/// surface that lies anyhow. One in three dives, at 5 to 90 degrees; a third of the others follow a groove
/// that the same burr cut before. Steps of 100 Hz or 1 kHz. All evenly over their ranges, the feed
/// in its logarithm.
struct RandomMotion {
    SteadyCase motion{};
    SteadyRun run{};
    double tilt_deg = 0.0;     ///< of the spindle from the surface's normal
    double azimuth_deg = 0.0;  ///< of that tilt, from the feed
    bool dives = false;
};

/// The same for the same seed on every machine.
std::vector<RandomMotion> random_motions(int count, std::uint64_t seed, double voxel_mm = 0.1);

/// Brings them all to one depth, which may be less than a voxel; grooves cut before are left out.
void set_depth(std::vector<RandomMotion>& motions, double depth_mm);

/// Gives their burrs edge forces: K_te and K_re of 0 to 1 N/mm, K_ae of 0 to 0.2. The motions stay the same.
void draw_edge_forces(std::vector<RandomMotion>& motions, std::uint64_t seed);

/// Gives their burrs heads that are no balls, one to three diameters long, of all shapes alike; cones stand
/// on either end.
void draw_heads(std::vector<RandomMotion>& motions, std::uint64_t seed);

struct RandomResult {
    RandomMotion motion;
    glm::dvec3 reference_n{0.0};  ///< of a dive: its mean over the path
    glm::dvec3 force_n{0.0};
    double error = 0.0;                ///< of the mean force, a share of the reference
    double ripple = 0.0;               ///< rms about the mean, a share of it
    std::vector<double> deviations{};  ///< of means over 10 ms, shares of the mean
    double largest_step = 0.0;         ///< a share of the mean
    double step_us = 0.0;              ///< median
};
/// What was measured, without the motion.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RandomResult, reference_n, force_n, error, ripple, deviations,
                                   largest_step, step_us)

/// Mean force by the analytical reference. Along a path that dives the force changes with the depth: its mean
/// over it.
glm::dvec3 reference_over_path_n(const RandomMotion& drawn);

RandomResult measure(const RandomMotion& motion, const MakeModel& make_model);

/// Table with a header, a line a motion.
Table table_of(const std::vector<RandomResult>& results);

/// cases, median_error_percent, p90_error_percent and so on to max_error_percent; of motions along the
/// surface along_median_error_percent, along_p90_error_percent, ripple_p90_percent (also of feeds from 5 mm/s
/// on: ripple_p90_from_5_mm_per_s_percent), ripple_max_percent, window_p95_percent (of all means over 10 ms,
/// from their motion's), largest_step_p99 and _max (of steps at 1 kHz, times the mean); step_us_p50; worst:
/// the motions farthest off, by name.
nlohmann::ordered_json summary_of(const std::vector<RandomResult>& results);

}  // namespace osteomill::study
