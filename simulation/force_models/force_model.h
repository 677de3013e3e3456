// Interface of the force models, which the milling loop runs. A force model owns the bone, follows the burr,
// removes bone and computes the force of the bone on the burr. The milling model is one, the older contact
// models are others. force_models.h makes them by name.
#pragma once

#include <cstddef>
#include <memory>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/burr.h"
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

    /// Between steps: undoes milling of these voxels, or redoes it (removal_account.h). Real-time safe.
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

// Checks of a burr and of a command that every force model makes.

/// Most voxels across a burr, so that the values a model keeps for each row fit.
inline constexpr double most_voxels_across_burr = 500.0;

/// Throws std::invalid_argument, naming the burr, unless diameter, edges and spindle speed are above zero,
/// the cutting coefficients finite and not negative, the burr no more than 500 voxels across or long, and its
/// head and shank as burr.h has them.
void require_valid(const Burr& burr, double spacing_mm);

/// For models that know the ball alone: throws std::invalid_argument, naming burr and `model`, for any other
/// head.
void require_ball(const Burr& burr, const char* model);

/// Whether a command is finite, has a duration, and names one of `burr_count` burrs; its axis must be of unit
/// length. Real-time safe.
bool is_usable(const BurrCommand& command, std::size_t burr_count) noexcept;

}  // namespace osteomill
