// Log of a running server, as a test follows it: the number of times that a line occurred, and the bone that
// it removed.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/force_log_file.h"

namespace osteomill::testing {

inline int count(const std::string& text, const std::string& words) {
    int found = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
    return found;
}

/// True as soon as the line has occurred so often; false after a time that only a defect can take.
inline bool has_logged(ChildProcess& server, const std::string& words, int times = 1) {
    return eventually([&] {
        server.read_output();
        return count(server.err(), words) >= times;
    });
}

/// The newest figure in its log, of every five seconds; 0 before the first.
inline double logged_removal_mm3(const std::string& log) {
    const std::size_t at = log.rfind("removed ");
    return at == std::string::npos ? 0.0 : std::stod(log.substr(at + 8));
}

/// The newest figure in the part that becomes its force log, of many times a second; 0 before the first.
inline double logged_removal_mm3(const std::filesystem::path& force_log_part) {
    constexpr std::streamoff some_lines = 4096;
    std::ifstream in(force_log_part, std::ios::ate);
    in.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(in.tellg()) - some_lines));
    const auto lines = read_force_log(in);
    return lines.empty() ? 0.0 : lines.back().removed_mm3;
}

/// True as soon as more than so much bone is gone, however slow the machine is; false after a time that only
/// a defect can take.
inline bool has_removed(ChildProcess& server, double least_mm3) {
    return eventually([&] {
        server.read_output();
        return logged_removal_mm3(server.err()) > least_mm3;
    });
}
inline bool has_removed(const std::filesystem::path& force_log_part, double least_mm3) {
    return eventually([&] { return logged_removal_mm3(force_log_part) > least_mm3; });
}

}  // namespace osteomill::testing
