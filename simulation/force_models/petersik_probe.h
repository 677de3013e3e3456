// Multi-point surface probe, after Petersik, Pflesser, Tiede, Höhne and Leuwer, "Haptic volume interaction
// with anatomic models at sub-voxel resolution", Haptic Symposium 2002 (abstracts of two later
// papers of the group read; equations from general knowledge of the paper):
//
//     points i are spread over the burr's surface; those in bone are found at sub-voxel precision;
//     each of them casts a ray against its outward normal n_i to the bone's surface, length l_i;
//     u = - sum_i l_i n_i / |sum_i l_i n_i|      direction, out of the bone
//     d = max_i (length from point i along u to the bone's surface)
//     F = k d u.
//
// A point that enters the bone does so with l_i = 0, so direction and depth are continuous. Hard and soft
// bone push alike; with the burr wholly within bone the sum vanishes, and the force has faded out
// (trust_in_direction()). The points come in opposite pairs and do not turn with the spindle.
#pragma once

#include <vector>

#include "simulation/force_models/contact_law.h"
#include "simulation/force_models/erosion.h"

namespace osteomill {

struct PetersikSettings {
    double stiffness_n_per_mm = 2.0;  ///< k: 1 N at 0.5 mm, and a wall that an arm can render at 1 kHz
    int surface_points = 512;         ///< 0.4 mm apart on a 5 mm burr; even, at least 2
    double erosion_per_s = default_erosion_per_s;
};

class PetersikProbe final : public ContactLaw {
  public:
    /// Throws std::invalid_argument for a number of surface points that is odd or less than 2.
    explicit PetersikProbe(const PetersikSettings& settings = {});

    ContactReaction react(const BurrContact& contact) noexcept override;
    std::unique_ptr<ContactLaw> copy() const override { return std::make_unique<PetersikProbe>(*this); }

  private:
    PetersikSettings settings_;
    std::vector<glm::dvec3> normals_;   // outward, of the points; a Fibonacci lattice and its opposite
    std::vector<glm::dvec3> immersed_;  // those in bone; scratch of a step, room for all
};

}  // namespace osteomill
