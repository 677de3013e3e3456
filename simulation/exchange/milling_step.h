// Command and result of one step of the milling loop. Plain values, handed from thread to thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "common/scene/scene.h"
#include "common/session/seen_steps.h"
#include "simulation/engagement/engagement.h"

namespace osteomill {

/// The burr's target for a step. It moves there on a straight line from where the last step left it.
struct BurrCommand {
    std::uint64_t tick = 0;  ///< the tick that gave it, counted from 0
    ToolPose pose;           ///< at the end of the step, patient LPS; the axis is a unit vector
    bool spindle_on = false;
    std::size_t burr = 0;          ///< index into the scene's set
    double speed_share = 1.0;      ///< the spindle's speed relative to the burr's own, positive
    double elapsed_s = 0.0;        ///< duration of the step, positive
    bool wants_engagement = true;  ///< false: the result's engagement will not be used, save its time
    /// The burr that shall be put in this one's place; nothing: none.
    std::optional<std::size_t> wanted_burr{};
};

/// Removed bone per tissue label, mm^3; index = label.
using RemovedByTissue = std::array<double, 256>;

/// Result of a step. Overwritten in place, step after step: nothing in it allocates.
struct MillingResult {
    std::uint64_t step = 0;  ///< counts from 1; 0 means that no step has run yet
    double time_s = 0.0;     ///< session time at the end of the step
    ToolPose pose;           ///< where the burr now is
    std::size_t burr = 0;
    bool spindle_on = false;
    glm::dvec3 force_n{0.0};   ///< milling force of the bone on the burr, mean over the step, patient axes
    double removed_mm3 = 0.0;  ///< by this step
    double total_removed_mm3 = 0.0;  ///< since the start
    bool touches_protected = false;  ///< the step removed protected tissue
    /// Changes that gave bone back, by undo, since the start: counted, so that a reader who skips results
    /// misses none.
    std::uint64_t restored_changes = 0;
    bool valid = true;  ///< false: the command was refused (not finite), force is zero
    /// Only of models without an engagement, with the spindle off: bone lies inside the burr.
    bool has_bone_inside = false;
    /// How far the tool may move from `pose` with neither its burr nor the wanted one meeting bone; 0: that
    /// is not known, or none is wanted.
    double room_for_change_mm = 0.0;
    std::optional<std::size_t> wanted_burr{};  ///< the command's
    Engagement engagement;                     ///< the bone around the burr after the step
    std::array<StepRun, newest_step_runs>
        newest_runs{};  ///< runs of steps, this one's last; empty runs first
};

}  // namespace osteomill
