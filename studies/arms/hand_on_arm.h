// A simulated hand of any strength on an arm of any make mills a scene, by the scene's own trajectory, to
// show the arm's effect on the force on the hand. The program's own loops and coupling run on the virtual
// clock.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "devices/simulated/hand_and_arm.h"

namespace osteomill::study {

struct HandOnArm {
    ArmModel arm{};
    HandModel hand = hand_model(Grip::firm);
    std::string coupling = "implicit";
    std::string force_model = "milling";
    double milling_rate_hz = 1000.0;
    /// The stiffness of the coupling's spring, in place of the one that the arm gets.
    std::optional<double> stiffness_n_per_mm{};
    double longest_s = 60.0;
};

/// The force on the hand, patient axes, a tick a millisecond, up to the trajectory's end, or until the safety
/// monitor lets go. Throws std::invalid_argument for a coupling, model or rate that is none.
std::vector<glm::dvec3> forces_of(const Scene& scene, const Bone& bone, const HandOnArm& choice);

/// Simulated arms with the mass, encoder and claim of each that is shipped; friction as the simulated arm's
/// if it is not known.
std::vector<std::pair<std::string, ArmModel>> shipped_arms();

}  // namespace osteomill::study
