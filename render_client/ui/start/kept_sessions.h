// The sessions that were kept on this machine, named as a person names them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {

struct KeptSession {
    std::filesystem::path folder{};
    std::filesystem::path recording{};  ///< in it
    /// "Anna, jaw, 28 November 14:05, not passed, 14 of 20 points", with the local time at which the report
    /// says that it began; without a report, only the values in the folder's name.
    std::string title{};
    bool is_whole =
        true;  ///< else its program was ended in the middle, and the recording is whole until then
    bool has_report = false;    ///< report.html, in the folder
    bool is_under_way = false;  ///< a server that runs now writes it, or its report

    bool operator==(const KeptSession&) const = default;
};

/// The folders of `reports` that hold a recording, whole or not, the newest first. Only the first
/// `most_titled` have a title.
std::vector<KeptSession> sessions_in(const std::filesystem::path& reports, std::size_t most_titled = 20);

/// The title of the session in this folder (report_folder()).
std::string title_of_session(const std::filesystem::path& folder);

}  // namespace osteomill
