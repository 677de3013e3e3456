#include "haptic_server/streaming/fair_places.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

Origin origin_at(const char* address) {
    return origin_of(boost::asio::ip::make_address(address));
}

/// One more, who takes another's place if there is none.
void squeeze_in(FairPlaces& places, FairPlaces::Id id, const Origin& origin) {
    if (const auto oldest = places.in_the_way()) places.remove(*oldest);
    places.add(id, origin);
}

TEST(Origin, IsAnAddressOrTheNetworkThatOnePartyHas) {
    EXPECT_EQ(origin_at("10.0.0.1"), origin_at("::ffff:10.0.0.1"));
    EXPECT_NE(origin_at("10.0.0.1"), origin_at("10.0.0.2"));
    EXPECT_EQ(origin_at("2001:db8:1:2::1"), origin_at("2001:db8:1:2:ffff:ffff:ffff:ffff"));
    EXPECT_NE(origin_at("2001:db8:1:2::1"), origin_at("2001:db8:1:3::1"));
    EXPECT_NE(origin_at("::1"), origin_at("0.0.0.0"));
    EXPECT_NE(origin_at("::a00:1"), origin_at("10.0.0.1"));
}

TEST(FairPlaces, GoOldestFirstOfThoseWhoHoldMost) {
    FairPlaces places(3);
    places.add(1, origin_at("10.0.0.1"));
    places.add(2, origin_at("10.0.0.2"));
    EXPECT_FALSE(places.in_the_way());
    places.add(3, origin_at("10.0.0.2"));
    EXPECT_EQ(places.in_the_way(), 2U);
    EXPECT_TRUE(places.remove(2));
    EXPECT_FALSE(places.remove(2));
    places.add(4, origin_at("10.0.0.3"));
    EXPECT_EQ(places.in_the_way(), 1U) << "of equals the oldest";
    places.clear();
    EXPECT_EQ(places.size(), 0U);
    EXPECT_FALSE(places.in_the_way());
}

TEST(FairPlaces, AreNotTakenFromAnotherAddressByAFlood) {
    FairPlaces places(16);
    places.add(1, origin_at("2001:db8:1:2::7"));
    // Each from an address of its own, of one network.
    for (FairPlaces::Id id = 2; id < 10'000; ++id)
        squeeze_in(places, id, origin_at(("2001:db8:6:6::" + std::to_string(id)).c_str()));
    EXPECT_EQ(places.size(), 16U);
    EXPECT_TRUE(places.remove(1));
}

TEST(FairPlaces, ArePassedOnByAFloodFromOneAddressOnlyWhenAsManyHaveComeAsThereAre) {
    FairPlaces places(16);
    places.add(1, origin_at("127.0.0.1"));
    for (FairPlaces::Id id = 2; id <= 16; ++id) squeeze_in(places, id, origin_at("127.0.0.1"));
    EXPECT_EQ(places.in_the_way(), 1U);
    squeeze_in(places, 17, origin_at("127.0.0.1"));
    EXPECT_FALSE(places.remove(1));
}

TEST(FairPlaces, LeaveRoomAmongTheFilesThatMayBeOpen) {
    EXPECT_GE(places_for_unidentified(), 16U);
    EXPECT_LE(places_for_unidentified(), 512U);
}

}  // namespace
}  // namespace osteomill
