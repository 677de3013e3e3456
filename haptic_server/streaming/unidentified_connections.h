// Connections that have yet to say hello: a client that is about to, or a scan of ports.
//
// They have places of their own, so that they cannot take a client's; whose is taken when those are short:
// see FairPlaces. They are sent a hello and no more, so that a stranger costs no snapshot.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "haptic_server/streaming/fair_places.h"

namespace osteomill {

class UnidentifiedConnections {
  public:
    using Id = FairPlaces::Id;  ///< ascending in the order in which they came
    using Time = std::chrono::steady_clock::time_point;

    /// A client says hello within two round trips; this leaves room for a machine that is busy.
    static constexpr std::chrono::seconds patience{10};

    explicit UnidentifiedConnections(std::size_t most_at_once = places_for_unidentified())
        : places_(most_at_once) {}

    /// Who has to go before another can be added, if anyone.
    std::optional<Id> in_the_way() const { return places_.in_the_way(); }
    void add(Id id, const Origin& origin, Time now) {
        places_.add(id, origin);
        since_.emplace(id, now);
    }

    /// It has said hello, or has gone. False if it was none of these.
    bool remove(Id id) { return since_.erase(id) != 0 && places_.remove(id); }

    bool contains(Id id) const { return since_.contains(id); }
    /// Who has been silent for that long.
    std::vector<Id> overdue(Time now) const {
        std::vector<Id> overdue;
        for (const auto& [id, since] : since_)
            if (now - since >= patience) overdue.push_back(id);
        return overdue;
    }

    std::size_t size() const { return since_.size(); }

  private:
    std::map<Id, Time> since_;
    FairPlaces places_;
};

}  // namespace osteomill
