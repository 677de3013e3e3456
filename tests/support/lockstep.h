// A coupling and the milling model in lock step, as the virtual clock runs them: haptic ticks at 1 kHz, a
// milling step after every n-th, its result available from the next tick on.
#pragma once

#include <memory>

#include "simulation/coupling/coupling.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"

namespace osteomill::testing {

class Lockstep {
  public:
    Lockstep(Coupling& coupling, Bone bone, const Burr& burr, int ticks_per_step)
        : coupling_(coupling), model_(std::move(bone), {burr}, {}), ticks_per_step_(ticks_per_step) {}

    /// One haptic tick with the hand at `position_mm`; returns the coupling's result.
    CouplingOutput tick(const glm::dvec3& position_mm, bool spindle_on) {
        const HandState hand{.now_s = tick_s * static_cast<double>(++ticks_),
                             .tick_s = tick_s,
                             .pose = {position_mm, {0.0, 0.0, 1.0}},
                             .spindle_on = spindle_on};
        const CouplingOutput output = coupling_.tick(hand, *result_);
        if (ticks_ % ticks_per_step_ == 0)
            model_.step({.pose = output.burr_pose,
                         .spindle_on = spindle_on,
                         .burr = 0,
                         .elapsed_s = tick_s * ticks_per_step_},
                        hand.now_s, changes_, *result_);
        return output;
    }

    const MillingResult& result() const { return *result_; }
    const MillingModel& model() const { return model_; }

    static constexpr double tick_s = 0.001;

  private:
    Coupling& coupling_;
    MillingModel model_;
    ForgottenChanges changes_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();
    int ticks_per_step_;
    int ticks_ = 0;
};

}  // namespace osteomill::testing
