// Cues for the sound of a tool: which notes its spindle makes, and how hard it works.
#pragma once

#include "common/scene/tool_state.h"

namespace osteomill {

struct SoundCue {
    double rev_per_s = 0.0;           ///< of the spindle under its load; 0: it stands
    int edges = 6;                    ///< of the burr: edges * rev_per_s is the note of the cut
    double force_n = 0.0;             ///< of the cut, mean over a tooth period; 0: it turns in air
    double tooth_ripple_n = 0.0;      ///< amplitude of the force within the tooth period
    double relative_stiffness = 1.0;  ///< of the bone that is cut; 1: cortical bone
    double strain = 0.0;              ///< what the load took of the speed, as a share: 1 is a stall
};

/// `burr`: the tool's. A number that is not finite or out of range is replaced by the nearest valid one, so
/// that hostile data makes no unpleasant sound.
SoundCue cue_of(const ToolState& tool, const Burr& burr) noexcept;

}  // namespace osteomill
