#include "haptic_server/streaming/connection_quota.h"

#include <gtest/gtest.h>

#include <boost/asio/ip/address.hpp>

namespace osteomill {
namespace {

Origin origin_at(const char* address) {
    return origin_of(boost::asio::ip::make_address(address));
}

/// One more, who takes another's place if there is none.
void squeeze_in(ConnectionQuota& quota, ConnectionQuota::Id id, const Origin& origin) {
    if (const auto oldest = quota.next_to_go()) quota.remove(*oldest);
    quota.add(id, origin, {});
}

TEST(Origin, IsAnAddressOrTheNetworkThatOnePartyHas) {
    EXPECT_EQ(origin_at("10.0.0.1"), origin_at("::ffff:10.0.0.1"));
    EXPECT_NE(origin_at("10.0.0.1"), origin_at("10.0.0.2"));
    EXPECT_EQ(origin_at("2001:db8:1:2::1"), origin_at("2001:db8:1:2:ffff:ffff:ffff:ffff"));
    EXPECT_NE(origin_at("2001:db8:1:2::1"), origin_at("2001:db8:1:3::1"));
    EXPECT_NE(origin_at("::1"), origin_at("0.0.0.0"));
    EXPECT_NE(origin_at("::a00:1"), origin_at("10.0.0.1"));
}

TEST(ConnectionQuota, GoOldestFirstOfThoseWhoHoldMost) {
    ConnectionQuota quota(3);
    quota.add(1, origin_at("10.0.0.1"), {});
    quota.add(2, origin_at("10.0.0.2"), {});
    EXPECT_FALSE(quota.next_to_go());
    quota.add(3, origin_at("10.0.0.2"), {});
    EXPECT_EQ(quota.next_to_go(), 2U);
    EXPECT_TRUE(quota.remove(2));
    EXPECT_FALSE(quota.remove(2));
    quota.add(4, origin_at("10.0.0.3"), {});
    EXPECT_EQ(quota.next_to_go(), 1U) << "of equals the oldest";
    quota.clear();
    EXPECT_EQ(quota.size(), 0U);
    EXPECT_FALSE(quota.next_to_go());
}

TEST(ConnectionQuota, AreNotTakenFromAnotherAddressByAFlood) {
    ConnectionQuota quota(16);
    quota.add(1, origin_at("2001:db8:1:2::7"), {});
    // From many addresses of one network.
    for (ConnectionQuota::Id id = 2; id < 10'000; ++id)
        squeeze_in(quota, id, origin_at(("2001:db8:6:6::" + std::to_string(id)).c_str()));
    EXPECT_EQ(quota.size(), 16U);
    EXPECT_TRUE(quota.remove(1));
}

TEST(ConnectionQuota, ArePassedOnByAFloodFromOneAddressOnlyWhenAsManyHaveComeAsThereAre) {
    ConnectionQuota quota(16);
    quota.add(1, origin_at("127.0.0.1"), {});
    for (ConnectionQuota::Id id = 2; id <= 16; ++id) squeeze_in(quota, id, origin_at("127.0.0.1"));
    EXPECT_EQ(quota.next_to_go(), 1U);
    squeeze_in(quota, 17, origin_at("127.0.0.1"));
    EXPECT_FALSE(quota.remove(1));
}

TEST(ConnectionQuota, AreHereSinceTheyCame) {
    const ConnectionQuota::Time opening{};
    ConnectionQuota quota(3);
    quota.add(1, Origin{}, opening);
    quota.add(2, Origin{}, opening + std::chrono::seconds(10));
    EXPECT_TRUE(quota.here_since(opening - std::chrono::seconds(10)).empty());
    EXPECT_EQ(quota.here_since(opening), std::vector<ConnectionQuota::Id>{1});
    quota.remove(1);
    EXPECT_FALSE(quota.contains(1));
    EXPECT_TRUE(quota.contains(2));
    EXPECT_TRUE(quota.here_since(opening).empty());
}

TEST(ConnectionQuota, LeaveRoomAmongTheFilesThatMayBeOpen) {
    EXPECT_GE(unidentified_quota(), 16U);
    EXPECT_LE(unidentified_quota(), 512U);
}

}  // namespace
}  // namespace osteomill
