// Hertz contact with friction, after Agus, Giachetti, Gobbetti, Zanetti and Zorcolo, "Real-time haptic and
// visual simulation of bone dissection", IEEE Virtual Reality 2002 and Presence 12(1), 2003 (abstracts of
// these and of "Adaptive techniques for real-time haptic and visual simulation of bone dissection" read,
// which name the first two moments of the bone within the burr; equations from general knowledge of the
// papers). With chi the bone (here: the fraction of a voxel) and r from the burr's centre,
//
//     M = integral over the burr of chi,  M_1 = integral of chi r    its moments
//     n = - M_1 / |M_1|                                              normal of the contact
//     h solves M = pi h^2 (R - h/3)                                  its thickness
//     F_e = C R^2 (h/R)^(3/2) n                                      elastic force
//     a = sqrt(h R)                                                  radius of the contact
//     P(x) = 3 |F_e| / (2 pi a^2) sqrt(1 - x^2 / a^2)                pressure at x from its middle
//     F_mu = mu integral over x < a of P(x) (r × w) / |r × w|        friction against the spin w
//
// The force is F_e + F_mu with the spindle on, F_e alone with it off. C is that of bone of relative stiffness
// 1 times the mean relative stiffness of the bone in contact. On the disc r is the point of the burr's
// surface; a is no more than R. With the burr wholly within bone M_1 vanishes, and the force has faded out
// (trust_in_direction()).
//
// Erosion, too, is the paper's: all work against friction goes into removing bone, mu P |w × r| = alpha phi
// with phi the volume removed per area and second and alpha an energy per volume. Here the whole power W = mu
// integral of P |w × r| is spread over the bone that the burr covers as in erosion.h: W / alpha = e integral
// of cover over voxels with bone. In bone of stiffness s, alpha is s times as large. The rate is that at a
// step's end, held over the step: steps of 1 ms remove what steps of 0.1 ms do within 1 %, steps of 10 ms 3 %
// more.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "simulation/force_models/contact_law.h"

namespace osteomill {

struct HertzSettings {
    double elasticity_n_per_mm2 = 2.0;  ///< C: 1.1 N for a 5 mm burr at 0.5 mm, where it stiffens to 3.4 N/mm
    double friction = 0.3;              ///< mu
    /// alpha = mu K_r: cutting at speed v under a push F_n removes F_n v / K_r a second, friction mu F_n v /
    /// alpha; so a newton removes here what it does in milling with the published K_r = 40 N/mm^2.
    double erosion_mj_per_mm3 = 12.0;
};

/// Depth of the spherical cap of a ball of radius R that has a volume, in the same unit of length; 0 to 2 R.
double cap_height(double volume, double radius);

class HertzContact final : public ContactLaw {
  public:
    explicit HertzContact(const HertzSettings& settings = {});

    ContactReaction react(const BurrContact& contact) noexcept override;
    std::unique_ptr<ContactLaw> copy() const override { return std::make_unique<HertzContact>(*this); }

  private:
    static constexpr std::size_t rings = 8;
    static constexpr std::size_t spokes = 16;

    HertzSettings settings_;
    /// Points of the unit disc that bear an equal share of the force under Hertz's pressure.
    std::array<glm::dvec2, rings * spokes> bearing_points_;
};

}  // namespace osteomill
