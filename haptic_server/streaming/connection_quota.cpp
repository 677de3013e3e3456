#include "haptic_server/streaming/connection_quota.h"

#include <sys/resource.h>

#include <algorithm>
#include <boost/asio/ip/address.hpp>

namespace osteomill {

Origin origin_of(const boost::asio::ip::address& address) {
    if (address.is_v4()) return {.is_v6 = false, .network = address.to_v4().to_uint()};
    const boost::asio::ip::address_v6 v6 = address.to_v6();
    if (v6.is_v4_mapped())
        return {.is_v6 = false,
                .network = boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, v6).to_uint()};
    Origin origin{.is_v6 = true};
    const auto bytes = v6.to_bytes();
    for (std::size_t i = 0; i < 8; ++i) origin.network = origin.network << 8 | bytes[i];
    return origin;
}

std::optional<ConnectionQuota::Id> ConnectionQuota::next_to_go() const {
    if (held_.size() < most_) return std::nullopt;
    // Ties go to the holder that has the oldest connection.
    const auto most = std::ranges::max_element(holders_, [](const auto& a, const auto& b) {
        if (a.second.size() != b.second.size()) return a.second.size() < b.second.size();
        return *a.second.begin() > *b.second.begin();
    });
    return *most->second.begin();
}

void ConnectionQuota::add(Id id, const Origin& origin, Time now) {
    held_.emplace(id, Held{origin, now});
    holders_[origin].insert(id);
}

bool ConnectionQuota::remove(Id id) {
    const auto found = held_.find(id);
    if (found == held_.end()) return false;
    const auto holder = holders_.find(found->second.origin);
    holder->second.erase(id);
    if (holder->second.empty()) holders_.erase(holder);
    held_.erase(found);
    return true;
}

std::vector<ConnectionQuota::Id> ConnectionQuota::here_since(Time time) const {
    std::vector<Id> some;
    for (const auto& [id, held] : held_)
        if (held.since <= time) some.push_back(id);
    return some;
}

void ConnectionQuota::clear() {
    held_.clear();
    holders_.clear();
}

std::size_t unidentified_quota() {
    constexpr std::size_t plenty = 512;
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return plenty;
    return std::clamp<std::size_t>(files.rlim_cur / 2, 16, plenty);
}

}  // namespace osteomill
