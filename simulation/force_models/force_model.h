// Interface of the force models, which the milling loop runs. A force model owns the bone, follows the burr,
// removes bone and computes the force of the bone on the burr. The milling model is one, the older contact
// models are others. force_models.h makes them by name.
#pragma once

#include <memory>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// One thread at a time.
class ForceModel {
  public:
    virtual ~ForceModel() = default;

    /// Moves the burr to the command's pose at session time `time_s`, takes away the bone that goes (none
    /// while the spindle is off), pushes the changes and overwrites `result`. A command that is not finite,
    /// of no duration or of an unknown burr leaves bone and burr alone and makes the result invalid.
    /// Real-time safe.
    virtual void step(const BurrCommand& command, double time_s, ChangeSink& changes,
                      MillingResult& result) noexcept = 0;

    /// Between steps: undoes milling of these voxels, or redoes it (restore_bone.h). Real-time safe.
    virtual void restore(const BrickChange& change, BrickFractions fractions,
                         ChangeSink& changes) noexcept = 0;

    /// A copy that goes on from here alike, with a copy of the bone. Between steps.
    virtual std::unique_ptr<ForceModel> copy() const = 0;

    virtual const Bone& bone() const = 0;
    /// Bone removed since the start, less bone restored.
    virtual RemovedByTissue removed_mm3() const = 0;
    /// The same of one tissue, with a label below 256.
    virtual double removed_mm3(std::size_t label) const = 0;
};

}  // namespace osteomill
