// The folder of a session's report: the files that a session leaves there, and the rule that no two share
// one.
#pragma once

#include <filesystem>

namespace osteomill {

/// The path of the recording of the session that is reported in `folder`.
std::filesystem::path recording_in(const std::filesystem::path& folder);

/// Makes the folder. Throws std::runtime_error with one line if it cannot be made, or holds a session
/// already.
void prepare_report_folder(const std::filesystem::path& folder);

}  // namespace osteomill
