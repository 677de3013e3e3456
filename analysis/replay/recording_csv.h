// The tool of a recording as a table: time, pose, force, burr, spindle, removed bone.
#pragma once

#include <filesystem>
#include <fstream>

#include "common/files/atomic_file.h"
#include "common/recording/playhead.h"

namespace osteomill {

/// A line a state frame. Columns: time_s (since the recording began), session_time_s, burr_x_mm, burr_y_mm,
/// burr_z_mm, axis_x, axis_y, axis_z (unit, tip to shank), hand_x_mm, hand_y_mm, hand_z_mm, force_x_n,
/// force_y_n, force_z_n (on the hand), burr (its name, quoted), spindle (1: on), removed_mm3 (as the server
/// counted), nearest_structure (quoted name of the protected one; empty: none is near), nearest_structure_mm
/// (0 and below: the burr overlaps it). Patient LPS.
class RecordingCsv {
  public:
    /// Throws std::runtime_error where the file cannot be written.
    explicit RecordingCsv(const std::filesystem::path& file);
    void add(const Playhead& playhead);
    /// Makes it the file, which is as it was until then. Throws std::runtime_error where a line could not be
    /// written.
    void close();

  private:
    AtomicFile file_;
    std::ofstream out_;
};

}  // namespace osteomill
