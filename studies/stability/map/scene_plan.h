// Plan of a scene of the stability map, event by event: the same for a sampled run and for its truth.
//
//     guided      the tool is moved as in steady motion, so that the force, filters and delay lines are there
//     release     time 0 of the record: from here on it moves as hand and force will have it
//    settling    the shake of the release dies out, or grows
//     window      is judged
//     tail        the judge's filter looks ahead
//
// The cutting burr is fed at 6 mm/s, a careful hand's speed, or as fast as 1.5 N lets it: a person feeds as
// the force allows, and the usual load on a dental turbine is about 1 N (0.34 to 1.8 N).
//
// Frames: patient = device. Bone is {z <= 0}, the spindle points along +z, the feed along +x; at the release
// the truth's burr is at x = 0, off the voxels' lattice as a hand is.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "common/scene/burr.h"
#include "studies/stability/map/held_tool.h"
#include "studies/stability/map/map_case.h"

namespace osteomill::study {

inline constexpr double tick_s = 0.001;
inline constexpr double most_feed_mm_per_s = 6.0;
inline constexpr double most_steady_force_n = 1.5;
inline constexpr double wall_push_n = 1.0;
inline constexpr double touch_mm_per_s = 3.0;

/// In ticks.
struct SceneTiming {
    std::size_t ramp = 30;    ///< part of the guided ticks, in which speed and force come on
    std::size_t guided = 80;  ///< includes the ramp
    std::size_t settling = 300;
    std::size_t window = 400;
    std::size_t tail = 30;

    std::size_t released() const { return settling + window + tail; }
};

/// Between the burr and the tool that holds it.
struct Mount {
    double stiffness_n_per_mm = 0.0;  ///< 0: rigid
    double damping_n_s_per_mm = 0.0;

    bool is_rigid() const { return stiffness_n_per_mm == 0.0; }
    bool operator==(const Mount&) const = default;
};

/// How a method of --coupling holds the burr: the methods that put a spring between burr and hand are judged
/// against the truth with that spring, all others against a burr that is rigidly on the device.
Mount mount_of(const MapCase& c);

struct ScenePlan {
    MapScene scene = MapScene::cutting;
    Burr burr{};
    double depth_mm = 0.0;            ///< cutting
    double relative_stiffness = 1.0;  ///< cutting: the bone's
    double wall_n_per_mm = 0.0;       ///< wall
    HeldTool tool{};
    Mount mount{};
    /// Wall, bare arm: nothing holds it sideways, so it runs on a rail across the wall.
    bool is_on_rail = false;
    SceneTiming timing{};

    glm::dvec3 burr_at_release_mm{0.0};
    glm::dvec3 steady_force_n{0.0};  ///< cutting: by the bone on the burr
    double feed_mm_per_s = 0.0;      ///< cutting
    ToolMotion at_release{};         ///< the tool's
    HandIntent intent{};             ///< time 0 is the release
};

ScenePlan plan_of(const MapCase& c);

/// The stiffness of the spring that may store the tool's energy: the wall's or the mount's; 0: none.
double rendered_spring_n_per_mm(const ScenePlan& plan);

/// The tool's motion in a guided tick, `ticks` before the release or at it.
glm::dvec3 guided_position_mm(const ScenePlan& plan, std::size_t ticks_before_release);

}  // namespace osteomill::study
