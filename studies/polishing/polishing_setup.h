// The published polishing experiment, as far as it is published, and what had to be chosen to repeat it.
//
// Published: a cube of bone, a 5 mm burr, a user who slides it at about 6 mm/s for about 40 mm in about 7 s
// down to 3.5 mm below the surface, forces of 0.3 to 0.7 N. Not published: spindle speed, tilt, and how the
// slide lies on the bone. In one stroke it is a fresh slot, whose end costs 7.2 N at 10 000 rpm, more than
// twice what the arm renders; the simulated hand, which waits for a tool that is held back, then takes half a
// minute, and even at 80 000 rpm 8.6 s. Strokes of a few millimetres to and fro, each a pass some tenths of a
// millimetre deeper than the one before, cost less, and the shorter the less; but under the shortest ones
// force follows the strokes rather than the depth.
//
// Here: five strokes of 8 mm at 80 000 rpm: seven seconds and a half, 3.5 mm, up to 0.6 N. Shapes can be
// compared with the published figures, values cannot.
#pragma once

#include <string>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "devices/simulated/trajectory.h"

namespace osteomill::study {

/// The cube, and how burrs cut it beside their chips.
struct Specimen {
    Bone bone;
    glm::dvec3 edge_coefficients_n_per_mm{0.0};  ///< none: the published law
};

struct PolishingSetup {
    std::string force_model = "milling";  ///< as of --force-model
    std::string coupling = "implicit";    ///< as of --coupling
    double milling_rate_hz = 1000.0;

    std::string name() const { return force_model + "_" + coupling; }
};

/// Rate of the published milling loop.
inline constexpr double published_milling_rate_hz = 100.0;

/// The scene "cube" with the experiment's burr and strokes.
Scene polishing_scene(const glm::dvec3& edge_coefficients_n_per_mm);

/// The built-in polishing motion up to its deepest point: the way out of the bone is not part of the
/// experiment.
Trajectory polishing_slide(const Scene& scene);

/// Of the burr's lowest point below the surface, the burr's centre being there.
double depth_mm(const Scene& scene, const glm::dvec3& burr_mm);

}  // namespace osteomill::study
