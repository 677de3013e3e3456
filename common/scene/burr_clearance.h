// Clearance of a burr from a structure: from its head's surface to the structure's, at a pose.
//
// For a ball it is the distance of its centre less its radius. For any other head it is the least over balls
// that fill the head, in layers from its surface inwards. At the surface the balls are a tenth of the
// diameter apart, at most 0.25 mm; the clearance is off by no more than a third of that, beyond the distance
// field's own error. The shank is left out.
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

    /// In mm; at 0 and below the head touches, and a value below 0 is the depth of the structure's nearest
    /// part inside the head. Nothing if it is beyond the field's reach: for every clearance up to c a field
    /// must reach c + largest_radius_mm(). Real-time safe.
    std::optional<double> clearance_mm(const DistanceField& field, const ToolPose& pose) const noexcept;

    /// Largest radius of the head, from the spindle.
    double largest_radius_mm() const { return largest_radius_mm_; }

  private:
    /// Equal balls inside the head, round the spindle; a single one if it lies on the spindle.
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
