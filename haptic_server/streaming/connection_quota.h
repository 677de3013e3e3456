// Quota of connections that have not identified themselves yet, as of a new client or of a port scan. They
// never cost a client, which has, its connection.
//
// When the quota is full, the address that holds most loses its oldest connection. So one address, however
// fast it connects, never costs another its connection. Behind one address, or from very many, a connection
// is kept until N newer ones have come, N being the quota: with 512, and 1000 new ones a second, for half a
// second. A handshake takes two round trips, of 50 ms say.
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace boost::asio::ip {
class address;
}

namespace osteomill {

/// Origin of a connection: an IPv4 address, or the 64 bits of an IPv6 address that name a network, since one
/// machine may use all addresses of its network.
struct Origin {
    bool is_v6 = false;
    std::uint64_t network = 0;

    auto operator<=>(const Origin&) const = default;
};

/// An IPv4 address within IPv6 is an IPv4 address.
Origin origin_of(const boost::asio::ip::address& address);

class ConnectionQuota {
  public:
    using Id = std::uint64_t;  ///< ascending in the order in which they came
    using Time = std::chrono::steady_clock::time_point;

    /// At least one.
    explicit ConnectionQuota(std::size_t most) : most_(most) {}

    /// The connection that has to go before another can be added; none if the quota is not reached.
    std::optional<Id> next_to_go() const;
    void add(Id id, const Origin& origin, Time now);
    /// False if it has none.
    bool remove(Id id);
    bool contains(Id id) const { return held_.contains(id); }
    /// Those that came no later.
    std::vector<Id> here_since(Time time) const;
    std::size_t size() const { return held_.size(); }
    void clear();

  private:
    std::size_t most_;
    struct Held {
        Origin origin;
        Time since;
    };
    std::map<Id, Held> held_;
    std::map<Origin, std::set<Id>> holders_;  // none is empty
};

/// The quota: 512, or half of the files that the system lets this program open, so that clients, recordings
/// and devices have theirs.
std::size_t unidentified_quota();

}  // namespace osteomill
