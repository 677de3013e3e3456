// Steady motions drawn at random, so that nothing was tuned to them.
#pragma once

#include <cstdint>
#include <vector>

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
    double tilt_deg = 0.0;     ///< the spindle's, from the surface's normal
    double azimuth_deg = 0.0;  ///< that tilt's, from the feed
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

/// Mean force by the analytical reference. Along a path that dives the force changes with the depth: its mean
/// over it.
glm::dvec3 reference_over_path_n(const RandomMotion& drawn);
/// Likewise the sum of the magnitudes of that force's parts.
double reference_parts_over_path_n(const RandomMotion& drawn);

}  // namespace osteomill::study
