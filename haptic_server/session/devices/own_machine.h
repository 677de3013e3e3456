// Check that a device's server that proves nothing of itself is on this machine.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

#include "common/net/listen_address.h"

namespace osteomill {

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
