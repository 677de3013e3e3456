// A bounded number of places that strangers share, so that who takes many crowds out his own kind first.
//
// When they are short, one goes of those who hold most of them, the oldest. So one address, however fast it
// connects, never takes the place of another; and behind one address, or from very many, one keeps a place
// for as long as as many come after it as there are places: with 512 and 1000 a second half a second, ten
// round trips of 50 ms, of which a handshake takes two.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

namespace osteomill {

/// Where one comes from, as far as one party can have several addresses: an IPv4 address, or the 64 bits of
/// an IPv6 address that name a network, all of whose addresses one machine may use.
struct Origin {
    bool is_v6 = false;
    std::uint64_t network = 0;

    auto operator<=>(const Origin&) const = default;
};

/// An IPv4 address within IPv6 is an IPv4 address.
Origin origin_of(const boost::asio::ip::address& address);

class FairPlaces {
  public:
    using Id = std::uint64_t;  ///< ascending in the order in which they came

    /// At least one.
    explicit FairPlaces(std::size_t most) : most_(most) {}

    /// Who has to go before another can be added, if anyone.
    std::optional<Id> in_the_way() const;
    void add(Id id, const Origin& origin);
    /// False if it has none.
    bool remove(Id id);
    std::size_t size() const { return origins_.size(); }
    void clear();

  private:
    std::size_t most_;
    std::map<Id, Origin> origins_;
    std::map<Origin, std::set<Id>> holders_;  // none is empty
};

/// How many places there are: 512, or half of the files that the system lets this program open, so that
/// clients, recordings and devices have theirs.
std::size_t places_for_unidentified();

}  // namespace osteomill
