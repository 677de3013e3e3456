// The log of a server that runs, waited for: how often it has said something, and the bone that it removed.
#pragma once

#include <string>

#include "tests/support/child_process.h"
#include "tests/support/eventually.h"

namespace osteomill::testing {

inline int count(const std::string& text, const std::string& words) {
    int found = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
    return found;
}

/// True as soon as it has said so as often as that; false after a time that only a defect can take.
inline bool has_told(ChildProcess& server, const std::string& words, int times) {
    return eventually([&] {
        server.read_output();
        return count(server.err(), words) >= times;
    });
}

/// The newest figure in its log; 0 before the first.
inline double told_removal_mm3(const std::string& log) {
    const std::size_t at = log.rfind("removed ");
    return at == std::string::npos ? 0.0 : std::stod(log.substr(at + 8));
}

/// True as soon as more than so much bone is gone, however slow the machine is; false after a time that only
/// a defect can take.
inline bool has_removed(ChildProcess& server, double least_mm3) {
    return eventually([&] {
        server.read_output();
        return told_removal_mm3(server.err()) > least_mm3;
    });
}

}  // namespace osteomill::testing
