// Point spring, the oldest of the contact models: one point of the burr, the deepest in bone, on a spring,
//
//     F = k z n,
//
// with n the outward normal of the bone's surface where it lies nearest to the burr's centre, and z how deep
// the burr reaches below the tangent plane there. As for volumes in Avila and Sobierajski, "A haptic
// interaction method for volume visualization", IEEE Visualization 1996: a point contact force from the
// volume itself, its direction from the gradient (abstract read; equations from general knowledge of the
// paper). Hard and soft bone push alike.
//
// One point knows one wall. If two walls are equally near, in a slot or a corner, the direction jumps from
// one to the other. Once the centre lies within bone, the direction is lost (no force without a gradient).
// Models with many points were made to mend that.
#pragma once

#include "simulation/force_models/contact_law.h"
#include "simulation/force_models/erosion.h"

namespace osteomill {

struct PointSpringSettings {
    double stiffness_n_per_mm = 2.0;  ///< k: 1 N at 0.5 mm, and a wall that an arm can render at 1 kHz
    double erosion_per_s = default_erosion_per_s;
};

class PointSpring final : public ContactLaw {
  public:
    explicit PointSpring(const PointSpringSettings& settings = {}) : settings_(settings) {}

    ContactReaction react(const BurrContact& contact) noexcept override;
    std::unique_ptr<ContactLaw> copy() const override { return std::make_unique<PointSpring>(*this); }

  private:
    PointSpringSettings settings_;
};

}  // namespace osteomill
