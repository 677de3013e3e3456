// Connections before their hello: a new client, or a port scan.
//
// They have a quota of their own (ConnectionQuota), so that they never cost a client its connection. They are
// sent a hello and no more, so that a stranger costs no snapshot.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "haptic_server/streaming/connection_quota.h"

namespace osteomill {

class UnidentifiedConnections {
  public:
    using Id = ConnectionQuota::Id;  ///< ascending in the order in which they came
    using Time = std::chrono::steady_clock::time_point;

    /// A client says hello within two round trips; this leaves room for a machine that is busy.
    static constexpr std::chrono::seconds patience{10};

    explicit UnidentifiedConnections(std::size_t most_at_once = unidentified_quota())
        : quota_(most_at_once) {}

    /// The connection that has to go before another can be added; none where there is room.
    std::optional<Id> next_to_go() const { return quota_.next_to_go(); }
    void add(Id id, const Origin& origin, Time now) {
        quota_.add(id, origin);
        since_.emplace(id, now);
    }

    /// It has said hello, or has gone. False if it was none of these.
    bool remove(Id id) { return since_.erase(id) != 0 && quota_.remove(id); }

    bool contains(Id id) const { return since_.contains(id); }
    /// Those that have been silent for that long.
    std::vector<Id> overdue(Time now) const {
        std::vector<Id> overdue;
        for (const auto& [id, since] : since_)
            if (now - since >= patience) overdue.push_back(id);
        return overdue;
    }

    std::size_t size() const { return since_.size(); }

  private:
    std::map<Id, Time> since_;
    ConnectionQuota quota_;
};

}  // namespace osteomill
