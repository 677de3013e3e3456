// Clearance of a burr from a structure: from its head's surface to the structure's, at a pose.
//
// Of a ball, the distance of its centre less its radius. Of any other head, the least over balls that fill
// it, in layers from its surface inwards, a tenth of its diameter apart there and at most 0.25 mm: off by no
// more than a third of that beyond the distance field's own error. The shank is left out.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/bone/distance_field.h"
#include "common/scene/burr.h"
#include "common/scene/scene.h"

namespace osteomill {

class BurrClearance {
  public:
    /// Allocates. Throws std::invalid_argument as BurrProfile does.
    explicit BurrClearance(const Burr& burr);

    /// In mm; not above 0: it touches, and below 0 says how deep the structure's nearest part is inside the
    /// head. Nothing where it is further than the field tells: for every clearance up to c a field must reach
    /// c + largest_radius_mm(). Real-time safe.
    std::optional<double> clearance_mm(const DistanceField& field, const ToolPose& pose) const noexcept;

    /// Of the head, from the spindle.
    double largest_radius_mm() const { return largest_radius_mm_; }

  private:
    /// Equal balls inside the head, round the spindle; one, if on it.
    struct Ring {
        double height_mm;  ///< above the burr's centre
        double radius_mm;  ///< of the ring
        double ball_radius_mm;
        int balls;
    };
    std::vector<Ring> rings_;
    double largest_radius_mm_;
};

}  // namespace osteomill
