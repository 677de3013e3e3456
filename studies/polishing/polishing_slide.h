// The published polishing experiment as a scene, and one slide of it through the simulator itself: session,
// loops, coupling and force guard as a user gets them, on the virtual clock.
// python/osteomill/studies/polishing.py lists the published facts and the values that had to be chosen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "devices/simulated/trajectory.h"

namespace osteomill::study {

struct PolishingSetup {
    std::string force_model = "milling";  ///< as of --force-model
    std::string coupling = "implicit";    ///< as of --coupling
    double milling_rate_hz = 1000.0;
};

/// How a slide ended.
struct SlideEnd {
    bool reached_end = false;  ///< the hand came to the end of its motion in time
    std::uint64_t faults = 0;  ///< how often a fault turned the force off
};

class PolishingSlide {
  public:
    /// The scene "cube", its burr with these edges and this speed; the slide in strokes of that length.
    PolishingSlide(const glm::dvec3& edge_coefficients_n_per_mm, double spindle_rpm, double stroke_mm);

    /// The point at which it begins, on the bone's surface.
    const glm::dvec3& start_mm() const { return scene_.trajectory.start_mm; }
    double burr_radius_mm() const { return scene_.burrs.at(scene_.start_burr).radius_mm(); }

    /// The motion that the hand means, to its deepest point: the way out of the bone is not of the
    /// experiment.
    double meant_s() const { return meant_.duration_s(); }
    glm::dvec3 meant_mm(double time_s) const { return meant_.at(time_s).target.position_mm; }

    /// The simulated hand slides; the session's log of forces is left in `log` (csv_log.h). Throws
    /// std::runtime_error if that cannot be written, std::invalid_argument for a set-up that the simulator
    /// refuses.
    SlideEnd run(const PolishingSetup& setup, const std::filesystem::path& log) const;

  private:
    Scene scene_;
    Bone cube_;
    Trajectory meant_;
};

}  // namespace osteomill::study
