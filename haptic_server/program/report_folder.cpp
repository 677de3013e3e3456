#include "haptic_server/program/report_folder.h"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

namespace osteomill {

std::filesystem::path recording_in(const std::filesystem::path& folder) {
    return folder / "session.pcap";
}

void prepare_report_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("--report {}: cannot make the folder: {}", folder.string(), error.message()));
    for (const char* name : {"session.pcap", "report.html", "metrics.csv", "metrics.json"})
        if (std::filesystem::exists(std::filesystem::symlink_status(folder / name)))
            throw std::runtime_error(fmt::format(
                "--report {}: holds a session already ({}); name another folder", folder.string(), name));
}

}  // namespace osteomill
