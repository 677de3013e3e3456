// Sites where bone ends, with the motion of a hand there, and random walks of a hand over bone.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"
#include "devices/simulated/trajectory.h"

namespace osteomill::study {

// A site where bone ends, and the motion of a hand there. The stability study tries such sites beside slots
// and walls.

/// Bone as a function of position (patient LPS, mm), within a box.
struct SiteShape {
    std::function<double(const glm::dvec3&)> distance_mm;  ///< signed, negative in bone
    glm::dvec3 low_mm{0.0};
    glm::dvec3 high_mm{0.0};
    /// The bone's stiffness, 1 = that of K_t = 230 N/mm^2; empty: 1 everywhere.
    std::function<double(const glm::dvec3&)> relative_stiffness{};
};

struct Site {
    std::string kind;  ///< a panel of the chart
    std::string name;  ///< without the burr
    Burr burr{};
    SiteShape shape;
    std::vector<Waypoint> motion;  ///< the hand's intent
};

inline constexpr double site_voxel_mm = 0.1;

/// A voxel's fraction falls from all to nothing over a voxel about the shape's surface.
Bone site_bone(const SiteShape& shape);

// A random walk of a hand over bone: a motion that nobody tuned to, the same for a seed and a number on every
// machine.

inline constexpr double walk_s = 4.0;
inline constexpr double walk_band_hz = 5.0;
inline constexpr double fastest_walk_mm_per_s = 150.0;

/// Walk `number` of a seed: sums of sines up to 5 Hz, at most 20 to 150 mm/s fast, about the surface, edges
/// and corners of a block, a plate or a ridge; burrs of 1 to 5 mm, 5 000 to 80 000 rpm.
Site random_walk(std::uint64_t seed, int number);

}  // namespace osteomill::study
