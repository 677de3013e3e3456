// Connections that have yet to say their first word, where no certificate says who they are: a client that
// is about to greet, one from before protocol 1.3, which never does, or a scan of ports.
//
// They have places of their own, so that they cannot take a client's; when those are short, the oldest gives
// way. One who stays silent is served after a while all the same, as it may be an old client; one who leaves
// before that has cost no snapshot.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace osteomill {

class Newcomers {
  public:
    using Id = std::uint64_t;  ///< ascending in the order in which they came
    using Time = std::chrono::steady_clock::time_point;

    /// All 32 clients may come at once, as after a server's restart, and strangers between them. At 1000
    /// connections a minute, each of which stays, one has three seconds to say its word.
    static constexpr std::size_t most_at_once = 48;
    static constexpr std::chrono::milliseconds patience{500};

    /// Who has to go before another can be added, if anyone.
    std::optional<Id> in_the_way() const {
        if (waiting_.size() < most_at_once) return std::nullopt;
        return waiting_.begin()->first;
    }
    void add(Id id, Time now) { waiting_.emplace(id, Waiting{now}); }

    /// It has spoken, or has gone. False if it was none of these.
    bool remove(Id id) { return waiting_.erase(id) > 0; }

    /// Who has been silent for long enough to be served; each is named once, and stays.
    std::vector<Id> take_patient(Time now) {
        std::vector<Id> patient;
        for (auto& [id, waiting] : waiting_) {
            if (waiting.is_served || now - waiting.since < patience) continue;
            waiting.is_served = true;
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
};

}  // namespace osteomill
