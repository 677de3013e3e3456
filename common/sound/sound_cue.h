// Cues for the sound of a tool: which notes its spindle makes, and how hard it works.
#pragma once

#include "common/session/tool_state.h"

namespace osteomill {

struct SoundCue {
    double rev_per_s = 0.0;           ///< the spindle under its load; 0: it stands
    int edges = 6;                    ///< the burr's edges: edges * rev_per_s is the note of the cut
    double force_n = 0.0;             ///< the cut's force, mean over a tooth period; 0: it turns in air
    double tooth_ripple_n = 0.0;      ///< amplitude of the force within the tooth period
    double relative_stiffness = 1.0;  ///< the stiffness of the bone that is cut; 1: cortical bone
    double strain = 0.0;              ///< the share of the speed that the load took: 1 is a stall
};

/// `burr`: the tool's. A number that is not finite or out of range is replaced by the nearest valid one, so
/// that hostile data makes no unpleasant sound.
SoundCue cue_of(const ToolState& tool, const Burr& burr) noexcept;

}  // namespace osteomill
