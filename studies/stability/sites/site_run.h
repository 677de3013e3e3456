// A run of the program's own loops at a site, in a simulated hand on the virtual clock, with the milling
// model's force beside it; and the verdict on it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/session/tool_state.h"
#include "devices/simulated/hand_and_arm.h"
#include "studies/stability/sites/site.h"

namespace osteomill::study {

// A run of the program's own loops at a site, in a simulated hand on the virtual clock, and the milling
// model's force beside it.

/// How a site is worked on.
struct SiteHand {
    std::string method = "implicit";  ///< as of --coupling
    bool feed_forward = false;        ///< of bone's change, of a method that has one
    Grip grip = Grip::firm;
    bool is_ideal_device = true;  ///< no encoder steps and no Coulomb friction
    int delay_ticks = 0;          ///< from a reading of the device to its force, beyond the loop's own
};

struct SiteTick {
    glm::dvec3 hand_mm{0.0};  ///< where it really is
    glm::dvec3 burr_mm{0.0};  ///< in the bone
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    glm::dvec3 force_n{0.0};  ///< the motors', from here to the next tick
    bool spindle_on = false;
    /// The milling model's force on the burr, over the way here: the hand should feel it.
    glm::dvec3 model_n{0.0};
    /// On a burr that is rigidly the hand, over the hand's way here, in steps of 20 us.
    glm::dvec3 rigid_n{0.0};
};

struct SiteRun {
    std::vector<SiteTick> ticks;
    SolveCounts solve;
    std::uint64_t faults = 0;  ///< all kinds together
};

/// Until the hand has gone its way, or three times as long as it meant to take. Throws std::invalid_argument
/// for an unknown method.
SiteRun run_site(const Site& site, const SiteHand& hand);

}  // namespace osteomill::study
