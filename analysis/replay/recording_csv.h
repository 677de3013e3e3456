// The tool of a recording as a table: a line a tick, as the session's own log has it, or a line a state
// frame.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>

#include "common/files/atomic_file.h"
#include "common/recording/playhead.h"

namespace osteomill {

enum class CsvLines {
    ticks,  ///< states, if the recording holds no ticks
    states,
    trajectory,  ///< the hand's; a line a tick, if there are ticks
};

/// Ticks: as haptic_server --log-csv writes them, to the digit (tick_sample.h).
/// States, columns: time_s (since the recording began), session_time_s, burr_x_mm, burr_y_mm,
/// burr_z_mm, axis_x, axis_y, axis_z (unit, tip to shank), hand_x_mm, hand_y_mm, hand_z_mm, force_x_n,
/// force_y_n, force_z_n (on the hand), burr (its name, quoted), spindle (1: on), removed_mm3 (as the server
/// counted), nearest_structure (quoted name of the protected one; empty: none is near), nearest_structure_mm
/// (0 and below: the burr overlaps it). Patient LPS.
/// Trajectory: as simulated hands follow it (written_pose.h), from time 0 at the recording's first
/// line; the pedal is down where the spindle turned. A comment above names the recorded arm. Other actions on
/// the session (undo, place) are no motion.
class RecordingCsv {
  public:
    /// Throws std::runtime_error if the file cannot be written.
    RecordingCsv(const std::filesystem::path& file, CsvLines lines) : file_(file), lines_(lines) {}
    /// Throws std::runtime_error if a session that was joined to another has other columns, or would
    /// follow it in a trajectory, and if it cannot be written.
    void add(const Playhead& playhead);
    /// Makes it the file, which is as it was until then. Throws std::runtime_error if that fails.
    void close() { file_.commit(); }

  private:
    void add_waypoints(fmt::memory_buffer& text, const Playhead& playhead);
    void begin_columns(const std::string& header_line);

    AtomicFile file_;
    const CsvLines lines_;
    std::string header_line_;  // empty before the first line
    std::optional<double> trajectory_begins_s_{};
    double waypoint_s_ = 0.0;  // the last one's
};

}  // namespace osteomill
