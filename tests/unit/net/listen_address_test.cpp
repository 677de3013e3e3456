#include "common/net/listen_address.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill {
namespace {

TEST(ListenAddress, ReadsAddressAndPort) {
    const ListenAddress where = parse_listen_address("192.168.0.7:7011");
    EXPECT_EQ(where.address, "192.168.0.7");
    EXPECT_EQ(where.port, 7011);
    EXPECT_EQ(parse_listen_address("localhost:0").address, "127.0.0.1");
    EXPECT_EQ(parse_listen_address("[::1]:65535").address, "::1");
}

TEST(ListenAddress, KnowsWhatOnlyThisMachineCanReach) {
    EXPECT_TRUE(is_loopback(parse_listen_address("127.0.0.1:1")));
    EXPECT_TRUE(is_loopback(parse_listen_address("127.9.9.9:1")));
    EXPECT_TRUE(is_loopback(parse_listen_address("[::1]:1")));
    EXPECT_FALSE(is_loopback(parse_listen_address("0.0.0.0:1")));
    EXPECT_FALSE(is_loopback(parse_listen_address("[::]:1")));
}

TEST(ListenAddress, RefusesWhatIsNone) {
    for (const char* text : {"", "7010", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:70100",
                             "127.0.0.1:-1", "localhosts:1", "::1:7010", "[::1:7010", "300.0.0.1:7010"}) {
        EXPECT_THROW(parse_listen_address(text), std::invalid_argument) << text;
    }
}

}  // namespace
}  // namespace osteomill
