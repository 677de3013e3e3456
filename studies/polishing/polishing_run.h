// One slide of the polishing experiment through the simulator itself: session, loops, coupling and force
// guard as a user gets them, on the virtual clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/bone/bone.h"
#include "studies/polishing/force_record.h"
#include "studies/polishing/polishing_setup.h"

namespace osteomill::study {

struct PolishingRun {
    ForceRecord record;        ///< from the first bone removed to the end of the slide
    double slide_s = 0.0;      ///< how long that took
    bool reached_end = false;  ///< the hand came to the end of its motion in time
    double depth_mm = 0.0;     ///< largest, of the burr's lowest point
    double stray_mm = 0.0;     ///< largest distance of the burr from the line of the slide, along the surface
    std::uint64_t faults = 0;  ///< how often a fault turned the force off
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PolishingRun, record, slide_s, reached_end, depth_mm, stray_mm, faults)

/// The simulated hand slides over `cube`, the scene's. Recorded is the force that it feels, a sample a
/// millisecond; the session's own log is left in `log`. Throws std::runtime_error where that cannot be
/// written, std::invalid_argument for a set-up that the simulator refuses.
PolishingRun run_by_hand(const Specimen& cube, const PolishingSetup& setup, const std::filesystem::path& log);
}  // namespace osteomill::study
