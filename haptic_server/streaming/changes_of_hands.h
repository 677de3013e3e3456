// Log lines about who moves the tool.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "haptic_server/streaming/control_lease.h"

namespace osteomill {

class ChangesOfHands {
  public:
    /// A line for who has let go since the last look, then one for who has it now; none where it is the same.
    /// `peer_of` gives the name of a client that is there.
    template <typename PeerOf>
    std::vector<std::string> look(std::optional<ControlLease::ClientId> holder, PeerOf&& peer_of) {
        std::vector<std::string> lines;
        if (holder == holder_) return lines;
        if (holder_) lines.push_back(fmt::format("client {} no longer moves the tool", peer_));
        if (holder) peer_ = peer_of(*holder);
        if (holder) lines.push_back(fmt::format("client {} moves the tool", peer_));
        holder_ = holder;
        return lines;
    }

  private:
    std::optional<ControlLease::ClientId> holder_;
    std::string peer_;  // theirs, who may have gone
};

}  // namespace osteomill
