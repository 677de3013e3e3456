// The report of a recording: report.html, metrics.csv and metrics.json in a folder. A live session writes it
// at its end, and packet_replay writes it from a recording.
#pragma once

#include <filesystem>
#include <string>

#include "common/program/progress.h"

namespace osteomill {

/// Makes the folder, and replaces the three files. `on_frame` is called now and then with the share that is
/// done, 0 to 1, and may throw to stop; then no file is written. Returns one line that says why reading
/// stopped before the recording's end; empty if it did not. Throws RecordingError if it holds no bone,
/// std::runtime_error if a file cannot be written.
std::string write_report(const std::filesystem::path& recording, const std::filesystem::path& folder,
                         const ReportProgress& on_frame);

}  // namespace osteomill
