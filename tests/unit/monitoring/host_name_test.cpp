#include "haptic_server/monitoring/host_name.h"

#include <gtest/gtest.h>

#include <array>

namespace osteomill {
namespace {

constexpr std::span<const std::string> none{};

TEST(HostName, IsOwnIfItIsAnAddressOrALoopbackName) {
    for (const char* host : {"", "localhost", "localhost:9464", "LocalHost:9464", "localhost.",
                             "localhost.:9464", "a.localhost", "127.0.0.1", "127.0.0.1:9464", "127.8.8.8",
                             "[::1]", "[::1]:9464", "192.0.2.7:80", "[2001:db8::1]:1"})
        EXPECT_TRUE(is_own_host(host, none)) << host;
}

TEST(HostName, IsStrangeIfSomebodyElseMayHaveMadeIt) {
    for (const char* host : {"evil.example",
                             "evil.example:9464",
                             "localhost.evil.example",
                             "notlocalhost",
                             "127.0.0.1.evil.example",
                             "evil.example.",
                             "localhost:9464.evil.example",
                             "localhost@evil.example",
                             "localhost evil.example",
                             "[::1",
                             "[::1].evil.example",
                             "[evil.example]",
                             "127.1",
                             "2130706433",
                             "0x7f000001",
                             ".",
                             ":9464",
                             "::1",
                             "xn--localhost",
                             " localhost",
                             "localhost\t",
                             "\xff"})
        EXPECT_FALSE(is_own_host(host, none)) << host;
}

TEST(HostName, IsOwnIfItWasAllowed) {
    const std::array<std::string, 2> names{"monitor.lab", "Proxy"};
    for (const char* host : {"monitor.lab", "MONITOR.lab:80", "proxy", "proxy.:9"})
        EXPECT_TRUE(is_own_host(host, names)) << host;
    for (const char* host : {"a.monitor.lab", "lab", "proxy.evil.example"})
        EXPECT_FALSE(is_own_host(host, names)) << host;
}

}  // namespace
}  // namespace osteomill
