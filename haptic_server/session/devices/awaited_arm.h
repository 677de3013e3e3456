// The wait for an arm that is not there yet, with messages about the missing parts.
#pragma once

#include <string>

#include "haptic_server/session/device_entry.h"

namespace osteomill {

/// Passes on the arm's messages meanwhile. False: a stop came first.
template <typename Arm>
bool has_come(Arm& arm, const DeviceContext& context) {
    std::string said;
    return arm.await([&] {
        const std::string notice = arm.notice();
        if (notice != said && !notice.empty()) context.say(notice);
        said = notice;
        return context.stop.load();
    });
}

}  // namespace osteomill
