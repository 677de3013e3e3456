// Trace of a session, sample by sample, from its recording: tool, force, and the bone of each tissue that
// each frame removed.
//
// Sample i stands for the interval from sample i - 1 to itself, dt = t_i - t_(i-1); the first has none. Times
// are session time. If recordings were joined, the trace is of the last session.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/plunge_watch.h"
#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "common/program/progress.h"
#include "common/scene/scene.h"
#include "common/session/session_control.h"
#include "common/session/structure_watch.h"
#include "common/session/viewpoint.h"
#include "common/wire/session_info.h"

namespace osteomill {

/// Bone in whole levels of fraction, so nothing is lost to rounding: 255 are a voxel.
struct TissueLevels {
    std::uint8_t tissue = 0;    ///< label; 0: none
    std::int64_t milled = 0;    ///< taken by the burr
    std::int64_t restored = 0;  ///< given back by undo and reset, less the volume that redo took again
};

/// A tick within a frame, or the frame itself if the recording holds no ticks.
struct TraceMoment {
    double time_s = 0.0;
    double dt_s = 0.0;     ///< since the one before
    double force_n = 0.0;  ///< magnitude, on the hand
    double depth_mm = 0.0;
    bool spindle_on = false;
};

struct TraceSample {
    double time_s = 0.0;
    glm::dvec3 hand_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    double force_n = 0.0;  ///< magnitude, on the hand
    double depth_mm = 0.0;
    std::size_t burr = 0;
    bool spindle_on = false;
    bool is_paused = false;
    bool is_placed = false;  ///< the tool was put elsewhere, in the interval before this sample or after it
    std::vector<TraceMoment> moments{};          ///< of the interval
    std::vector<TissueLevels> levels{};          ///< only of tissues that changed; ascending labels
    std::vector<StructureDistance> distances{};  ///< to protected structures that are near or were touched
    std::optional<double> spindle_to_surface_deg{};  ///< where it cuts: 90 is square to it, 0 along it
    std::optional<bool> burr_in_view{};              ///< where it cuts; nothing: the viewpoint is not known

    std::int64_t milled() const;
    std::int64_t restored() const;
    bool cuts() const { return milled() > 0; }
};

struct SessionTrace {
    SessionInfo session;
    Bone at_start;
    Bone at_end;
    std::vector<TraceSample> samples{};
    std::vector<ControlEvent> events{};
    std::vector<StructureAccount> structures{};  ///< those that have a place in this bone
    std::vector<Structure> structure_places{};   ///< their voxels
    std::vector<Breakthrough> breakthroughs{};
    std::optional<double> peak_force_n{};  ///< of all ticks, where the recording says it
    std::int64_t began_unix_ns = 0;        ///< 0: not said
    std::uint64_t bone_checksum = 0;       ///< at the end
    bool ends = false;                     ///< with a goodbye, in the recording
    std::string error{};                   ///< why it is not read further; empty at the end

    /// Duration of the frame as a whole.
    double dt_s(std::size_t i) const {
        return i == 0 ? 0.0 : std::max(0.0, samples[i].time_s - samples[i - 1].time_s);
    }
    /// A position discontinuity: the tool was put elsewhere in this interval, so no hand moved that far. The
    /// first frame after a placement reports it; its tool may be that of the tick before.
    bool is_discontinuous(std::size_t i) const {
        return i > 0 && (samples[i].is_placed || samples[i - 1].is_placed);
    }
    double mm3(std::int64_t levels) const {
        return static_cast<double>(levels) / 255.0 * voxel_volume_mm3(at_start.grid());
    }
};

/// Reads a recording through; `on_frame` is called before each frame. Throws RecordingError if it holds no
/// bone; `error` says what is wrong later.
SessionTrace read_trace(const std::filesystem::path& file, const ReportProgress& on_frame);

// Normal of a bone's surface at a burr: it points away from the bone on a sphere round the burr.
//
// It is minus the mean of those of 256 evenly spread directions (Fibonacci's lattice) that meet bone on the
// sphere. At a plane it is the plane's own normal, whatever crater the burr made under itself; in a hole it
// leads out.

/// Unit, patient LPS. Nothing if the sphere meets no bone, or as much on every side.
std::optional<glm::dvec3> normal_about(const Bone& bone, const glm::dvec3& centre_mm, double radius_mm);

// Test whether the burr is in view: its centre lies in the picture, and no bone hides it.
//
// No bone hides it if the straight line from the eye to the burr's centre meets no bone surface, which is
// where half a voxel is left (bone_ray.h). A tissue drawn with less than half of its colour (opacity) hides
// nothing. Neither does the handpiece, which is not recorded. The picture's height is the viewpoint's field
// of view; its width is not recorded and is assumed to be 16 / 9 of the height.

inline constexpr double taken_picture_width = 16.0 / 9.0;  ///< of its height

/// `burr_mm`: its centre, patient LPS. An eye at the very place of the burr sees it.
bool is_burr_in_view(const Bone& bone, const std::vector<Tissue>& tissues, const Viewpoint& view,
                     const glm::dvec3& burr_mm);

}  // namespace osteomill
