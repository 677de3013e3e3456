// Steady motions drawn at random, with a coupling and a hand on rails: how far the mean force on the hand is
// from the milling model's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/force/steady_case.h"

namespace osteomill::study {

/// Burrs of 1 to 5 mm, spindles that lean by up to 60 degrees, feeds from 1 mm/s, depths from 0.12 mm to the
/// equator, over a surface that lies anyhow; the rest as of random_motions.h. The same for the same seed on
/// every machine.
std::vector<SteadyCase> motions_on_rails(int count, std::uint64_t seed);

struct OnRails {
    glm::dvec3 hand_n{0.0};   ///< mean force on the hand
    glm::dvec3 model_n{0.0};  ///< mean of the milling model, over the burr's own way
    /// Bone pulled the burr away from the hand, so that it was damped (burr_proxy.h): no steady motion.
    bool is_driven = false;
};

/// A quarter of a second of `c` with the coupling of that name, after three quarters to get there: milling
/// and haptic loop at 1 kHz, in turns, a device without steps or friction that goes where it is meant to.
/// Throws std::invalid_argument for an unknown coupling.
OnRails run_on_rails(const SteadyCase& c, const std::string& coupling, bool feed_forward = false);

}  // namespace osteomill::study
