#include "haptic_server/device/bridge/bridge_host.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <random>

#include "tests/unit/device/bridge/bridge_pair.h"

namespace osteomill {
namespace {

using testing::BridgePair;
using Datagram = BridgePair::Datagram;
using Datagrams = std::vector<Datagram>;

TEST(BridgeHost, KnowsTheArmOnceAPoseHasComeNotBefore) {
    BridgePair bridge;
    bridge.pass_back = [](const Datagram&) { return Datagrams{}; };  // no welcome arrives
    bridge.exchange(50);
    EXPECT_FALSE(bridge.host.arm());
    EXPECT_TRUE(bridge.host.is_gone(bridge.now_ns));
    bridge.pass_back = [](const Datagram& one) { return Datagrams{one}; };
    bridge.exchange(50);
    ASSERT_TRUE(bridge.host.arm());
    EXPECT_STREQ(bridge.host.arm()->name, "test arm");
    EXPECT_EQ(bridge.host.arm()->max_force_n, 3.0);
    EXPECT_FALSE(bridge.host.is_gone(bridge.now_ns));
    omb_close(&bridge.link);
    bridge.link.socket = OMB_NO_SOCKET;
}

TEST(BridgeHost, TakesNoPoseTwiceNorAnOlderOne) {
    BridgePair bridge;
    bridge.exchange(100);
    bridge.pose.position_mm[0] = 5.0;
    const Datagrams before = bridge.sent;
    bridge.exchange(2);
    const int fresh = bridge.fresh_poses;
    for (const Datagram& one : before) bridge.deliver(one, bridge.peer);
    EXPECT_EQ(bridge.fresh_poses, fresh);
    EXPECT_EQ(bridge.host.pose().position_mm[0], 5.0);
    EXPECT_GE(bridge.host.counts().out_of_order, 90u);
}

TEST(BridgeHost, CountsWhatIsLostAndDoubled) {
    BridgePair bridge;
    bridge.exchange(100);
    std::mt19937 random(1);
    std::uint64_t lost = 0;
    std::uint64_t doubled = 0;
    bridge.pass_on = [&](const Datagram& one) {
        const auto dice = random() % 20;
        if (dice == 0) ++lost;
        if (dice == 1) ++doubled;
        return dice == 0 ? Datagrams{} : dice == 1 ? Datagrams{one, one} : Datagrams{one};
    };
    bridge.exchange(1000);
    bridge.pass_on = [](const Datagram& one) { return Datagrams{one}; };
    bridge.exchange();
    EXPECT_EQ(bridge.host.counts().lost, lost);
    EXPECT_EQ(bridge.host.counts().out_of_order, doubled);
    EXPECT_NEAR(bridge.force.force_n[2], 1.0, 1e-9);
}

TEST(BridgeHost, ARecordedHelloOfBeforeChangesNothing) {
    BridgePair bridge;
    bridge.exchange(100);
    const Datagram hello = bridge.sent.front();
    const int fresh = bridge.fresh_poses;
    const PeerAddress arm = bridge.peer;
    for (int i = 0; i < 20; ++i) {
        bridge.deliver(hello, {1, 2, 3, 4});  // from elsewhere
        bridge.deliver(hello, arm);           // or as if from the arm
        bridge.exchange();
    }
    EXPECT_EQ(bridge.fresh_poses, fresh + 20);
    EXPECT_EQ(bridge.host.counts().other_arms, 20u);
}

TEST(BridgeHost, TakesNoArmThatCannotBe) {
    for (double omb_arm::*value : {&omb_arm::max_force_n, &omb_arm::max_stiffness_n_per_mm,
                                   &omb_arm::apparent_mass_kg, &omb_arm::position_step_mm}) {
        for (const double wrong : {std::nan(""), -1.0, 1e9}) {
            omb_arm arm = testing::some_arm();
            arm.*value = wrong;
            EXPECT_NE(why_impossible(arm), nullptr);
            Datagram hello(OMB_MESSAGE_BYTES);
            const omb_header header{OMB_HELLO, 0, 1, 1};
            const omb_key none{};
            omb_put_header(hello.data(), &header);
            omb_put_hello(hello.data(), 5, &arm);
            omb_seal(hello.data(), &none);
            BridgeHost host({}, [] { return std::uint64_t{9}; });
            EXPECT_FALSE(host.take(hello, {1}, 1));
            EXPECT_STREQ(host.refusal(), why_impossible(arm));
        }
    }
    EXPECT_EQ(why_impossible(testing::some_arm()), nullptr);
}

TEST(BridgeHost, ActsOnNoPoseThatCannotBe) {
    BridgePair bridge;
    bridge.exchange(50);
    const int fresh = bridge.fresh_poses;
    bridge.pose.position_mm[1] = std::nan("");
    bridge.exchange(5);
    bridge.pose = testing::ready_pose();
    bridge.pose.quaternion[0] = 0.5;
    bridge.exchange(5);
    bridge.pose.quaternion[0] = std::numeric_limits<double>::infinity();
    bridge.exchange(5);
    EXPECT_EQ(bridge.fresh_poses, fresh);
    EXPECT_EQ(bridge.host.counts().impossible, 15u);
}

TEST(BridgeHost, MeasuresTheWayThereAndBackByOneClockEach) {
    BridgePair bridge;
    bridge.exchange(400);
    ASSERT_TRUE(bridge.host.round_trip_median_s());
    // An exchange a millisecond; the answer waits for the next one, which the arm says.
    EXPECT_NEAR(*bridge.host.round_trip_median_s(), 0.001, 1e-6);
}

TEST(BridgeHost, WithAKeyHearsOnlyWhoHasIt) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "key") << std::string(40, 'k');
    std::ofstream(folder / "other") << std::string(40, 'o');
    omb_key key;
    omb_set_key(&key, reinterpret_cast<const std::uint8_t*>(std::string(40, 'k').data()), 40);
    BridgePair same(testing::some_arm(), key, (folder / "key").c_str());
    same.exchange(200);
    EXPECT_NEAR(same.given_n(), 1.0, 1e-9);
    BridgePair other(testing::some_arm(), key, (folder / "other").c_str());
    other.exchange(200);
    EXPECT_FALSE(other.host.arm());
    EXPECT_GT(other.host.counts().refused, 5u);
    BridgePair none(testing::some_arm(), key);
    none.exchange(200);
    EXPECT_FALSE(none.host.arm());
}

// Whoever listens may send again all that was ever said, in this session or one before.
TEST(BridgeHost, WithAKeyNothingThatWasSaidMovesItAgain) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "key") << std::string(40, 'k');
    omb_key key;
    omb_set_key(&key, reinterpret_cast<const std::uint8_t*>(std::string(40, 'k').data()), 40);
    BridgePair bridge(testing::some_arm(), key, (folder / "key").c_str());
    bridge.pose.buttons = OMB_PEDAL;
    bridge.exchange(300);
    const Datagrams sent = bridge.sent;
    const Datagrams answers = bridge.answers;
    bridge.pose.buttons = 0;
    for (int round = 0; round < 2; ++round) {
        bridge.exchange(300);
        const int fresh = bridge.fresh_poses;
        for (const Datagram& one : sent) bridge.deliver(one, bridge.peer);
        EXPECT_EQ(bridge.fresh_poses, fresh);
        EXPECT_EQ(bridge.host.pose().buttons, 0u);
        bridge.wanted.force_n = {};
        bridge.exchange(200);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            bridge.send_to_arm(answers[i]);
            bridge.exchange();
            ASSERT_EQ(bridge.given_n(), 0.0) << "forces of before";
        }
        // A session later the same.
        bridge.is_server_stopped = true;
        bridge.exchange(300);
        bridge.is_server_stopped = false;
        bridge.host = BridgeHost(key, [] { return std::uint64_t{4711}; });
    }
}

TEST(BridgeHost, IsMovedByNoGarbage) {
    BridgePair bridge;
    bridge.exchange(50);
    std::mt19937 random(3);
    const int fresh = bridge.fresh_poses;
    for (int i = 0; i < 20000; ++i) {
        Datagram garbage(random() % 3 == 0 ? random() % 300 : OMB_MESSAGE_BYTES);
        if (garbage.size() == OMB_MESSAGE_BYTES && random() % 2 == 0) garbage = bridge.sent.back();
        for (auto& byte : garbage)
            if (random() % 8 == 0) byte = static_cast<std::uint8_t>(random());
        if (garbage.size() > 8) garbage[8] ^= 0x55;  // another session
        bridge.host.take(garbage, {9, 9}, bridge.now_ns);
        EXPECT_FALSE(bridge.host.has_fresh_pose());
    }
    bridge.exchange(10);
    EXPECT_EQ(bridge.fresh_poses, fresh + 10);
}

}  // namespace
}  // namespace osteomill
