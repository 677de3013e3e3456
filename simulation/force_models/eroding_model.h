// Force model made of a contact law and erosion, as in the time before milling laws: at each step a
// ContactLaw gives the force of the overlapped bone, and erosion.h removes bone while the spindle is on. The
// force is for the bone before the step's erosion; with the spindle off the same force is the wall. The burr
// erodes at the midpoint of its step, so that one slow step removes as much as many quick ones; it does not
// sweep, as the published models do not.
//
// There is no cutting law here for a coupling to solve: the result's engagement is always empty. One thread
// at a time.
#pragma once

#include <memory>
#include <vector>

#include "common/scene/scene.h"
#include "simulation/engagement/brick_neighbourhood.h"
#include "simulation/force_models/contact_law.h"
#include "simulation/force_models/erosion.h"
#include "simulation/force_models/force_model.h"
#include "simulation/force_models/removal_account.h"

namespace osteomill {

class ErodingModel final : public ForceModel {
  public:
    /// `burrs` and `tissues` as in the scene. Throws std::invalid_argument for an empty burr set or a burr
    /// that require_valid() (force_model.h) refuses.
    ErodingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                 std::unique_ptr<ContactLaw> law);

    void step(const BurrCommand& command, double time_s, ChangeSink& changes,
              MillingResult& result) noexcept override;

    void restore(const BrickChange& change, BrickFractions fractions, ChangeSink& changes) noexcept override;

    ErodingModel(const ErodingModel& other);
    std::unique_ptr<ForceModel> copy() const override { return std::make_unique<ErodingModel>(*this); }

    const Bone& bone() const override { return bone_; }
    RemovedByTissue removed_mm3() const override { return account_.removed_mm3(); }
    double removed_mm3(std::size_t label) const override { return account_.removed_mm3(label); }

  private:
    void erode(const glm::dvec3& position_mm, double dose, ChangeSink& changes) noexcept;

    Bone bone_;
    TurningBurrs burrs_;
    std::unique_ptr<ContactLaw> law_;
    BrickNeighbourhood bricks_;
    Erosion erosion_;
    RemovalAccount account_;
    UncutTissues uncut_;

    bool has_position_ = false;  // position_mm_ and burr_ hold the last step's
    glm::dvec3 position_mm_{0.0};
    std::size_t burr_ = 0;
};

}  // namespace osteomill
