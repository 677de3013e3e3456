// A burr pressed with a constant load while it is led along a surface: what it removes, and how deep it
// sinks. So hand loads and removal rates that were published can be set beside the simulator's.
#pragma once

#include <nlohmann/json.hpp>

#include "common/scene/burr.h"
#include "common/scene/material.h"

namespace osteomill::study {

/// One stroke over fresh, flat material, the spindle upright, the burr led on a stiff guide.
struct PressedStroke {
    Burr burr{};  ///< its coefficients are those for cortical bone
    Material material{};
    double load_n = 0.64;
    double feed_mm_per_s = 4.0;
    double length_mm = 6.0;
};

/// Over the last third of the stroke; nothing where the burr sinks.
struct PressedResult {
    double removal_mm3_per_s = 0.0;
    double depth_mm = 0.0;  ///< of the burr's tip below the surface
    /// The burr sank to its equator, which no stroke of a hand does: the rate means nothing.
    bool sinks = false;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PressedResult, removal_mm3_per_s, depth_mm, sinks)

/// With the milling model and the proxy of the coupling `implicit` (burr_proxy.h), at 1 kHz.
PressedResult press(const PressedStroke& stroke);

}  // namespace osteomill::study
