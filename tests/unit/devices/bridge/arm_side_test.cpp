// The force on the hand, whatever the server or the network does: bridge/osteomill_bridge.h.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "tests/unit/devices/bridge/bridge_pair.h"

namespace osteomill {
namespace {

using testing::BridgePair;
using Datagrams = std::vector<BridgePair::Datagram>;

/// Runs for so many milliseconds; the largest change of force from one exchange to the next.
double largest_jump_n(BridgePair& bridge, int milliseconds) {
    double jump_n = 0.0;
    for (int i = 0; i < milliseconds; ++i) {
        double before[3];
        std::memcpy(before, bridge.force.force_n, sizeof before);
        bridge.exchange();
        double change[3];
        for (int axis = 0; axis < 3; ++axis) change[axis] = bridge.force.force_n[axis] - before[axis];
        jump_n = std::max(jump_n, omb_length(change));
    }
    return jump_n;
}

TEST(ArmSide, GivesTheServersForce) {
    BridgePair bridge;
    EXPECT_EQ(bridge.exchange(), OMB_SEEKING);
    EXPECT_LT(largest_jump_n(bridge, 200), 0.02) << "it comes up gently";
    EXPECT_EQ(bridge.exchange(), OMB_RUNNING);
    EXPECT_NEAR(bridge.force.force_n[2], 1.0, 1e-9);
}

TEST(ArmSide, FadesTheForceWithin50MsOfSilenceAndBringsItBackWithoutAJump) {
    BridgePair bridge;
    bridge.wanted.force_n = {0.0, 2.0, 0.0};
    bridge.exchange(200);
    ASSERT_NEAR(bridge.given_n(), 2.0, 1e-9);
    bridge.is_server_stopped = true;
    double before_n = 2.0;
    for (int ms = 1; ms <= 60; ++ms) {
        const omb_state state = bridge.exchange();
        // The newest answer is to the exchange of a millisecond before the silence.
        if (ms < 4) {
            EXPECT_NEAR(bridge.given_n(), 2.0, 1e-9) << ms;
        }
        if (ms > 6) {
            EXPECT_EQ(state, OMB_FADING);
        }
        if (ms >= 50) {
            EXPECT_EQ(bridge.given_n(), 0.0) << ms;
        }
        EXPECT_LE(bridge.given_n(), before_n + 1e-12);
        EXPECT_LT(before_n - bridge.given_n(), 0.05) << ms;
        before_n = bridge.given_n();
    }
    bridge.is_server_stopped = false;
    EXPECT_LT(largest_jump_n(bridge, 200), 0.03);
    EXPECT_NEAR(bridge.given_n(), 2.0, 1e-9);
}

// The arm kept the last force meanwhile; now it must go, but not at a stroke.
TEST(ArmSide, LetsGoInAFewMillisecondsWhenItHasItselfStoodStill) {
    BridgePair bridge;
    bridge.wanted.force_n = {3.0, 0.0, 0.0};
    bridge.exchange(200);
    ASSERT_NEAR(bridge.given_n(), 3.0, 1e-9);
    bridge.now_ns += 1'000'000'000;
    EXPECT_LT(largest_jump_n(bridge, 14), 0.26) << "no step is longer than of a loop on time";
    EXPECT_LT(bridge.given_n(), 1e-9 + 3.0 * 14 / 100) << "what comes back does so gently";
}

TEST(ArmSide, GivesNothingThatTheArmDoesNot) {
    BridgePair bridge;
    bridge.exchange(200);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& wanted : {glm::dvec3(1e9, -1e9, 5.0), glm::dvec3(std::nan(""), 1.0, 1.0),
                                     glm::dvec3(infinity), glm::dvec3(0.0, 1e300, 0.0)}) {
        bridge.wanted.force_n = wanted;
        bridge.wanted.torque_n_mm = wanted;
        EXPECT_LE(largest_jump_n(bridge, 20), 1.0 + 1e-9) << "1000 N/s";
        EXPECT_LE(bridge.given_n(), 3.0 + 1e-9);
        EXPECT_LE(omb_length(bridge.force.torque_n_mm), 100.0 + 1e-9);
        for (const double value : bridge.force.force_n) EXPECT_TRUE(std::isfinite(value));
    }
    omb_arm without_torque = testing::some_arm();
    without_torque.max_torque_n_mm = 0.0;
    BridgePair plain(without_torque);
    plain.wanted.torque_n_mm = {5.0, 5.0, 5.0};
    plain.exchange(200);
    EXPECT_EQ(omb_length(plain.force.torque_n_mm), 0.0);
}

TEST(ArmSide, GivesNothingWhileItIsNotReadyOrTheServerHoldsStill) {
    BridgePair bridge;
    bridge.exchange(200);
    bridge.pose.status &= ~static_cast<std::uint32_t>(OMB_READY);
    EXPECT_LT(largest_jump_n(bridge, 13), 0.3);
    EXPECT_EQ(bridge.given_n(), 0.0);
    bridge.pose.status |= OMB_READY;
    EXPECT_LT(largest_jump_n(bridge, 200), 0.02);
    EXPECT_NEAR(bridge.given_n(), 1.0, 1e-9);
    bridge.wanted.is_off = true;
    EXPECT_LT(largest_jump_n(bridge, 14), 0.3);
    EXPECT_EQ(bridge.given_n(), 0.0);
    EXPECT_EQ(bridge.force.is_off, 1u);
}

TEST(ArmSide, TakesEachForceOnceAndNoneOutOfOrder) {
    BridgePair bridge;
    bridge.exchange(200);
    const Datagrams old = bridge.answers;
    for (const auto& one : old) bridge.send_to_arm(one);
    bridge.exchange(10);  // at most 64 at a time
    EXPECT_GE(bridge.link.out_of_order + bridge.link.refused, old.size() - 1);
    EXPECT_NEAR(bridge.force.force_n[2], 1.0, 1e-9);
    EXPECT_EQ(bridge.link.newest_sequence, bridge.host.counts().poses)
        << "the welcome's is 1; the last is under way";
}

// An answer from far away is as good as none, though one comes every millisecond.
TEST(ArmSide, GivesNothingWhenAnswersAre100MsOld) {
    BridgePair bridge;
    bridge.exchange(200);
    std::deque<BridgePair::Datagram> under_way;
    bridge.pass_back = [&](const BridgePair::Datagram& one) {
        under_way.push_back(one);
        if (under_way.size() <= 100) return Datagrams{};
        const Datagrams out{under_way.front()};
        under_way.pop_front();
        return out;
    };
    for (int ms = 0; ms < 50; ++ms) bridge.exchange();
    for (int ms = 0; ms < 500; ++ms) {
        bridge.exchange();
        ASSERT_EQ(bridge.given_n(), 0.0) << ms;
    }
    EXPECT_GT(bridge.host.counts().late, 100u);
}

TEST(ArmSide, FindsAServerThatBeganAnew) {
    BridgePair bridge;
    bridge.exchange(200);
    const std::uint64_t before = bridge.link.session;
    bridge.host = BridgeHost({}, [] { return std::uint64_t{77}; });
    for (int ms = 0; ms < 240; ++ms) bridge.exchange();
    EXPECT_EQ(bridge.given_n(), 0.0);
    EXPECT_LT(largest_jump_n(bridge, 400), 0.02);
    EXPECT_NE(bridge.link.session, before);
    EXPECT_NEAR(bridge.given_n(), 1.0, 1e-9);
}

TEST(ArmSide, IsMovedByNoGarbage) {
    BridgePair bridge;
    bridge.exchange(200);
    std::mt19937 random(3);
    for (int ms = 0; ms < 200; ++ms) {
        for (int i = 0; i < 5; ++i) {
            BridgePair::Datagram garbage = bridge.answers.back();
            if (i == 0) garbage.resize(random() % 250);
            for (auto& byte : garbage)
                if (i < 3 || random() % 20 == 0) byte = static_cast<std::uint8_t>(random());
            // Without a key a message of the right form may say anything; so keep to those of another
            // session.
            if (garbage.size() >= 16) garbage[8] ^= 0x55;
            bridge.send_to_arm(garbage);
        }
        bridge.exchange();
        ASSERT_NEAR(bridge.force.force_n[2], 1.0, 1e-9);
    }
    EXPECT_GE(bridge.link.refused, 1000u);
}

TEST(ArmSide, SaysInOneLineWhyItCannotOpen) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "short") << "too short";
    std::filesystem::permissions(folder / "short", std::filesystem::perms::owner_read);
    std::ofstream(folder / "open") << std::string(40, 'k');
    std::filesystem::permissions(folder / "open",
                                 std::filesystem::perms::owner_read | std::filesystem::perms::others_read);
    const omb_arm arm = testing::some_arm();
    omb_arm weak = arm;
    weak.max_force_n = 0.0;
    omb_link link;
    const auto error = [&](const std::string& address, const char* key, const omb_arm& which) {
        EXPECT_EQ(omb_open(&link, address.c_str(), key, &which), -1) << address;
        EXPECT_EQ(std::string(link.error).find('\n'), std::string::npos);
        return std::string(link.error);
    };
    EXPECT_EQ(error("tcp:here", nullptr, arm), "tcp:here: must be udp:HOST:PORT or unix:PATH");
    EXPECT_EQ(error("udp:here", nullptr, arm), "here: must be udp:HOST:PORT");
    EXPECT_EQ(error("unix:" + std::string(200, 'a'), nullptr, arm),
              std::string(100, 'a') + ": is too long a path");
    EXPECT_EQ(error("udp:127.0.0.1:9", "/nowhere", arm), "/nowhere: cannot be read");
    EXPECT_EQ(error("udp:127.0.0.1:9", "/dev/zero", arm), "/dev/zero: cannot be read");
    EXPECT_NE(error("udp:127.0.0.1:9", (folder / "open").c_str(), arm).find("others may read it"),
              std::string::npos);
    EXPECT_NE(error("udp:127.0.0.1:9", (folder / "short").c_str(), arm).find("32 bytes at least"),
              std::string::npos);
    EXPECT_EQ(error("udp:127.0.0.1:9", nullptr, weak), "max_force_n: must be over 0");
    EXPECT_NE(error("unix:" + (folder / "no" / "arm").string(), nullptr, arm).find("cannot be answered"),
              std::string::npos);
}

}  // namespace
}  // namespace osteomill
