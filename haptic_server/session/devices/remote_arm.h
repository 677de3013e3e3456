// Arms behind a server of their own: the wait for one that is not there yet, and the rule that a server which
// proves nothing of itself is on this machine.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "common/net/listen_address.h"
#include "haptic_server/session/device_table.h"

namespace osteomill {

/// Waits for an arm, and passes on its messages meanwhile. False: a stop came first.
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

/// Throws std::invalid_argument, naming the option and the alternative. `usual`: the server's port.
inline void require_own_machine(const char* option, const char* why, const ListenAddress& server, int usual) {
    if (server.port == 0)
        throw std::invalid_argument(fmt::format("{}: port 0 is nowhere; {} is usual", option, usual));
    if (!is_loopback(server))
        throw std::invalid_argument(
            fmt::format("{}: {}, so it is taken from this machine alone; for {}: ssh -L {}:localhost:{} {}",
                        option, why, server.address, server.port, server.port, server.address));
}

}  // namespace osteomill
