// A burr that mills a scene along a prescribed path, as a stiff machine holds it, and what the program makes
// of it each millisecond: force, its harmonics within the tooth period, vibration, sound, engagement.
//
// A patch p of the burr's surface that touches bone and moves toward it cuts f_p, in the mean over a tooth
// period (Engagement). Equation (1) of docs/milling-model.md, the force at the instant when the edges stand
// at theta + 2 pi i / N, is then
//
//     F(theta) = sum_p f_p + 2 Re sum_k c_k exp(i k N theta),     c_k = sum_p f_p exp(-i k N psi_p)
//
// psi_p being the azimuth of the patch about the spindle, theta = sigma 2 pi n t. A patch is a sixteenth of a
// turn wide, so it is taken in six parts side by side, each with its own chip. Where bone ends is known by
// whole patches: more than 30 waves a turn are left out (five harmonics of six edges are there). All edges
// are alike: run-out is left to the vibration.
#pragma once

#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"

namespace osteomill::study {

inline constexpr double path_step_s = 0.001;

/// The parts of a path: a pose at the end of each millisecond.
struct PathStep {
    ToolPose pose{};
    bool spindle_on = true;
};

/// One entry a step, or three of a vector; forces and positions in patient axes, N and mm.
struct MilledPath {
    int harmonics = 0;
    std::vector<double> force_n{};        ///< of all parts of patches that cut, mean over a tooth period
    std::vector<double> model_force_n{};  ///< of the milling model, from the bone that the step removed
    std::vector<std::complex<double>> harmonic_n{};  ///< c_k: step, k from 1, axis
    std::vector<double> vibration_n{};               ///< that the arm would render (handpiece_vibration.h)
    std::vector<double> engaged_mm2{};         ///< of the burr's surface that touches bone, cutting or not
    std::vector<double> relative_stiffness{};  ///< of what is cut, weighed by its share of the force; else 0
    std::vector<double> removed_mm3{};
    /// Mean outward normal of what cuts, by area; zero where none does. So far, times the radius,
    /// from the burr's centre lies the middle of the cut.
    std::vector<double> normal{};
    std::vector<float> sound{};  ///< -1 to 1, BurrSound::rate_hz (burr_sound.h)
};

/// How many harmonics of the tooth period there are.
int harmonics_of(const Burr& burr);

/// Begins with the bone as it is given, the burr put down at the first pose; the rest are steps. Throws
/// std::invalid_argument for fewer than two poses, a burr that the scene has not, and what is not finite.
MilledPath mill_path(const Scene& scene, Bone bone, std::size_t burr, const std::vector<PathStep>& path);

}  // namespace osteomill::study
