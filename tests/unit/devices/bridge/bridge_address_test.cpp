#include <gmock/gmock.h>

#include <stdexcept>
#include <string>

#include "devices/bridge/datagram_socket.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

TEST(BridgeAddress, IsAPathOrAPort) {
    for (const char* text : {"unix:/tmp/arm", "unix:arm.sock", "udp:127.0.0.1:7020", "udp:[::1]:7020"})
        EXPECT_EQ(to_text(parse_bridge_address(text)), text);
    EXPECT_EQ(to_text(parse_bridge_address("udp:localhost:1")), "udp:127.0.0.1:1");
}

TEST(BridgeAddress, SaysWhetherOthersReachIt) {
    EXPECT_TRUE(is_local(parse_bridge_address("unix:/tmp/arm")));
    EXPECT_TRUE(is_local(parse_bridge_address("udp:127.0.0.1:7020")));
    EXPECT_TRUE(is_local(parse_bridge_address("udp:[::1]:7020")));
    EXPECT_FALSE(is_local(parse_bridge_address("udp:0.0.0.0:7020")));
    EXPECT_FALSE(is_local(parse_bridge_address("udp:192.168.7.10:7020")));
}

TEST(BridgeAddress, RefusesOthersInOneLine) {
    for (const auto& [text, words] :
         {std::pair("", "expected unix:PATH or udp:ADDRESS:PORT"), std::pair("unix:", "expected unix:PATH"),
          std::pair("tcp:127.0.0.1:1", "expected unix:PATH"), std::pair("udp:here:1", "numeric address"),
          std::pair("udp:127.0.0.1", "no port"), std::pair("udp:127.0.0.1:70000", "0 to 65535")}) {
        try {
            parse_bridge_address(text);
            FAIL() << text;
        } catch (const std::invalid_argument& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }
    EXPECT_THROW(parse_bridge_address("unix:" + std::string(76, 'a')), std::invalid_argument);
    EXPECT_NO_THROW(parse_bridge_address("unix:" + std::string(75, 'a')));
}

}  // namespace
}  // namespace osteomill
