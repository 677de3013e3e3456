// Round trips of the bridge's messages and of a bare echo, a thousand a second, in turns, so that other load
// on the machine falls on both.
#pragma once

#include <vector>

#include "devices/bridge/datagram_socket.h"

namespace osteomill::study {

struct RoundTrips {
    std::vector<double> bridge_us;  ///< from an arm's pose to the force that answers it
    std::vector<double> echo_us;    ///< for a datagram of the same size that comes back unchanged
};

/// The ends' places: threads made within `at_server` and `at_arm` run there.
struct Ends {
    BridgeAddress where;  ///< the server's; the echo is at a place beside it
    std::string server_namespace{};
    std::string arm_namespace{};  ///< empty: where this process is
    bool has_key = false;
};

/// Measures for so long, after a settling of a tenth of a second. Throws std::runtime_error if no socket
/// can be had or nothing is answered.
RoundTrips measure_round_trips(const Ends& ends, double seconds);

}  // namespace osteomill::study
