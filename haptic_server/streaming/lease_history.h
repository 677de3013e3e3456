// Log lines about changes of the client that moves the tool.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "haptic_server/streaming/tool_lease.h"

namespace osteomill {

class LeaseHistory {
  public:
    /// A line for the client that has let go since the last call, then one for the client that has the tool
    /// now; none if nothing changed. `peer_of` gives the name of a client that is connected.
    template <typename PeerOf>
    std::vector<std::string> update(std::optional<ToolLease::ClientId> holder, PeerOf&& peer_of) {
        std::vector<std::string> lines;
        if (holder == holder_) return lines;
        if (holder_) lines.push_back(fmt::format("client {} no longer moves the tool", peer_));
        if (holder) peer_ = peer_of(*holder);
        if (holder) lines.push_back(fmt::format("client {} moves the tool", peer_));
        holder_ = holder;
        return lines;
    }

  private:
    std::optional<ToolLease::ClientId> holder_;
    std::string peer_;  // that client's address; it may have gone
};

}  // namespace osteomill
