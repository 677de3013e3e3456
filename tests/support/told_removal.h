// What a server that runs has told of the bone it removed.
#pragma once

#include <string>

#include "tests/support/child_process.h"
#include "tests/support/eventually.h"

namespace osteomill::testing {

/// The newest figure in its log; 0 before the first.
inline double told_removal_mm3(const std::string& log) {
    const std::size_t at = log.rfind("removed ");
    return at == std::string::npos ? 0.0 : std::stod(log.substr(at + 8));
}

/// True as soon as more than so much bone is gone, however slow the machine is; false after a time that only
/// a defect can take.
inline bool has_removed(ChildProcess& server, double least_mm3) {
    return eventually([&] {
        (void)server.line_after("no such line", std::chrono::seconds(1));
        return told_removal_mm3(server.err()) > least_mm3;
    });
}

}  // namespace osteomill::testing
