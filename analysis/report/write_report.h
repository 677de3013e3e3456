// The report of a recording: report.html, metrics.csv and metrics.json in a folder. What a live session
// writes at its end and what packet_replay writes of its recording are both this.
#pragma once

#include <filesystem>
#include <string>

#include "common/program/progress.h"

namespace osteomill {

/// Makes the folder, and replaces the three files. `on_frame` is called now and then with the share that
/// is done, 0 to 1, and may throw to stop; then no file is written.
/// Returns one line that says why the recording is not read further than it is; empty at its end. Throws
/// RecordingError where there is no bone in it, std::runtime_error where a file cannot be written.
std::string write_report(const std::filesystem::path& recording, const std::filesystem::path& folder,
                         const ReportProgress& on_frame);

}  // namespace osteomill
