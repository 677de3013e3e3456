// Connections that have yet to say their first word, where no certificate says who they are: a client that
// is about to greet, one from before protocol 1.3, which never does, or a scan of ports.
//
// They have places of their own, so that they cannot take a client's; whose is taken when those are short:
// see FairPlaces. One who stays silent is served after a while all the same, as it may be an old client, but
// few of them at once; one who leaves before that has cost no snapshot.
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

    static constexpr std::chrono::milliseconds patience{500};
    /// So many silent ones are served at once: what a client is sent and has yet to be sent takes memory.
    static constexpr std::size_t most_served = 48;

    explicit UnidentifiedConnections(std::size_t most_at_once = places_for_unidentified())
        : places_(most_at_once) {}

    /// Who has to go before another can be added, if anyone.
    std::optional<Id> in_the_way() const { return places_.in_the_way(); }
    void add(Id id, const Origin& origin, Time now) {
        places_.add(id, origin);
        waiting_.emplace(id, Waiting{now});
    }

    /// It has spoken, or has gone. False if it was none of these.
    bool remove(Id id) {
        const auto found = waiting_.find(id);
        if (found == waiting_.end()) return false;
        if (found->second.is_served) --served_;
        waiting_.erase(found);
        return places_.remove(id);
    }

    /// Who has been silent for long enough to be served; each is named once, and stays.
    std::vector<Id> take_patient(Time now) {
        std::vector<Id> patient;
        for (auto& [id, waiting] : waiting_) {
            if (served_ >= most_served) break;
            if (waiting.is_served || now - waiting.since < patience) continue;
            waiting.is_served = true;
            ++served_;
            patient.push_back(id);
        }
        return patient;
    }

    std::size_t size() const { return waiting_.size(); }

  private:
    struct Waiting {
        Time since;
        bool is_served = false;
    };
    std::map<Id, Waiting> waiting_;
    std::size_t served_ = 0;
    FairPlaces places_;
};

}  // namespace osteomill
