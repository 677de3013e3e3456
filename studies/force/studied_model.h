// Interface of a force model under study, which carves: a step in, force and removal out. One small
// interface, so that the voxel model, its settings and the published scan run through the same motions.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>

#include "common/bone/bone.h"
#include "simulation/force_models/milling_model.h"

namespace osteomill::study {

struct StepOutcome {
    glm::dvec3 force_n{0.0};
    double removed_mm3 = 0.0;
};

class StudiedModel {
  public:
    virtual ~StudiedModel() = default;
    /// Burr 0 is the only one.
    virtual StepOutcome step(const BurrCommand& command) = 0;
    virtual const Bone& bone() const = 0;
};

/// Gives a model its bone and its only burr.
using MakeModel = std::function<std::unique_ptr<StudiedModel>(Bone bone, const Burr& burr)>;

/// The program's own model; by default as haptic_server uses it, but without the engagement that a coupling
/// may ask for beside the force: a step's time is that of the force.
MakeModel voxel_model(const MillingSettings& settings = {});

/// The same with the engagement, as the implicit coupling wants it.
MakeModel voxel_model_with_engagement();

}  // namespace osteomill::study
