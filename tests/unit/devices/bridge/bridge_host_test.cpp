#include "devices/bridge/bridge_host.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <random>

#include "tests/unit/devices/bridge/bridge_pair.h"

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

/// An arm's side that says what a test wants, at an address that it makes up.
class LyingArm {
  public:
    explicit LyingArm(BridgeHost& host, PeerAddress from, const omb_key& key = {})
        : host_(host), from_(std::move(from)), key_(key) {}

    Datagram hello(std::uint64_t nonce = 7, const omb_arm& arm = testing::some_arm()) {
        Datagram message = begun(OMB_HELLO, 0);
        omb_put_hello(message.data(), nonce, &arm);
        return sealed(std::move(message));
    }
    /// A pose that answers the last welcome, altered by `change`.
    Datagram pose(const std::function<void(omb_pose&)>& change = [](omb_pose&) {}) {
        Datagram message = begun(OMB_POSE, session);
        omb_pose pose = testing::ready_pose();
        pose.echo_sequence = welcome.sequence;
        pose.echo_clock_ns = welcome.clock_ns;
        change(pose);
        omb_put_pose(message.data(), &pose);
        return sealed(std::move(message));
    }
    /// Whether it was welcomed.
    bool says_hello(std::uint64_t now_ns, const omb_arm& arm = testing::some_arm()) {
        const auto answer = host_.take(hello(7, arm), from_, now_ns);
        if (answer && omb_get_header(answer->data(), answer->size(), &key_, &welcome) != 0)
            session = welcome.session;
        return answer.has_value();
    }
    /// Whether it is the arm that is served: its pose is to be answered.
    bool says_pose(std::uint64_t now_ns) {
        host_.take(pose(), from_, now_ns);
        const bool is_taken = host_.awaits_answer() && host_.peer() == from_;
        if (host_.awaits_answer()) host_.answer(now_ns, {});
        return is_taken;
    }
    void says_goodbye(std::uint64_t now_ns) {
        host_.take(sealed(begun(OMB_GOODBYE, session)), from_, now_ns);
    }

    omb_header welcome{};
    std::uint64_t session = 0;

  private:
    Datagram begun(omb_kind kind, std::uint64_t in_session) {
        Datagram message(OMB_MESSAGE_BYTES);
        const omb_header header{static_cast<std::uint16_t>(kind), in_session, ++said_, said_};
        omb_put_header(message.data(), &header);
        return message;
    }
    Datagram sealed(Datagram message) const {
        omb_seal(message.data(), &key_);
        return message;
    }

    BridgeHost& host_;
    PeerAddress from_;
    omb_key key_;
    std::uint64_t said_ = 0;
};

constexpr std::uint64_t ms = 1'000'000;

BridgeHost some_host() {
    return BridgeHost({}, [random = std::mt19937_64(5)]() mutable { return random(); });
}

TEST(BridgeHost, HellosInAnyNumberTakeNobodysPlace) {
    BridgeHost host = some_host();
    LyingArm stranger(host, {6});
    const Datagram recorded = stranger.hello();
    LyingArm arm(host, {1});
    ASSERT_TRUE(arm.says_hello(1000 * ms));
    for (std::uint64_t i = 0; i < 20'000; ++i)  // from one address, and from many
        host.take(recorded,
                  i % 2 == 0 ? PeerAddress{6} : PeerAddress{6, std::uint8_t(i), std::uint8_t(i >> 8)},
                  1000 * ms + i);
    // Other arms, made up: fewer than are remembered.
    for (int i = 0; i < 50; ++i) {
        omb_arm other = testing::some_arm();
        other.max_force_n = 1.0 + 0.01 * i;
        host.take(stranger.hello(8, other), {6}, 1001 * ms);
    }
    EXPECT_TRUE(arm.says_pose(1002 * ms));
    EXPECT_EQ(host.arm()->max_force_n, 3.0);
}

TEST(BridgeHost, AWelcomeIsGoodOnceAndSoonStaleAndForItsAddressAlone) {
    BridgeHost host = some_host();
    LyingArm arm(host, {1});
    ASSERT_TRUE(arm.says_hello(1000 * ms));
    const Datagram first = arm.pose();
    EXPECT_FALSE(arm.says_pose(1251 * ms)) << "stale";
    ASSERT_TRUE(arm.says_hello(2000 * ms));
    const Datagram second = arm.pose();
    host.take(second, {2}, 2001 * ms);
    EXPECT_FALSE(host.arm()) << "another's address";
    host.take(arm.pose([](omb_pose& pose) { ++pose.echo_sequence; }), {1}, 2001 * ms);
    host.take(arm.pose([](omb_pose& pose) { ++pose.echo_clock_ns; }), {1}, 2001 * ms);
    EXPECT_FALSE(host.arm()) << "another's welcome";
    for (int bit = 0; bit < 64; ++bit) {
        arm.session ^= std::uint64_t{1} << bit;
        EXPECT_FALSE(arm.says_pose(2001 * ms));
        arm.session ^= std::uint64_t{1} << bit;
    }
    EXPECT_TRUE(arm.says_pose(2002 * ms));
    arm.says_goodbye(2003 * ms);
    for (const Datagram& again : {first, second, arm.pose()}) {
        host.take(again, {1}, 2004 * ms);
        EXPECT_FALSE(host.awaits_answer()) << "a session that has ended";
    }
}

TEST(BridgeHost, AnArmThatIsAliveAgainIsNotTakenOver) {
    BridgeHost host = some_host();
    LyingArm arm(host, {1});
    LyingArm waiting(host, {2});
    ASSERT_TRUE(arm.says_hello(1000 * ms));
    ASSERT_TRUE(arm.says_pose(1001 * ms));
    EXPECT_FALSE(waiting.says_hello(1200 * ms)) << "one at a time";
    // After a long silence another arm connects; then the first is back before that one has sent a pose.
    ASSERT_TRUE(waiting.says_hello(1300 * ms));
    EXPECT_TRUE(arm.says_pose(1301 * ms));
    EXPECT_TRUE(host.has_fresh_pose() || arm.says_pose(1302 * ms));
    for (std::uint64_t at = 1303; at < 1500; ++at) EXPECT_FALSE(waiting.says_pose(at * ms));
    EXPECT_TRUE(arm.says_pose(1500 * ms));
    // Gone for good: the one who waits asks anew, and then it is the first that must wait.
    ASSERT_TRUE(waiting.says_hello(1800 * ms));
    EXPECT_TRUE(waiting.says_pose(1801 * ms));
    EXPECT_FALSE(arm.says_pose(1802 * ms));
    EXPECT_FALSE(arm.says_hello(1803 * ms));
    waiting.says_goodbye(1804 * ms);
    EXPECT_TRUE(arm.says_hello(1805 * ms));
    EXPECT_TRUE(arm.says_pose(1806 * ms));
}

TEST(BridgeHost, BetweenTwoArmsTheLoopLosesTheFirst) {
    BridgeHost host = some_host();
    LyingArm arm(host, {1});
    LyingArm other(host, {2});
    const BridgeForce wanted{.force_n = {1.0, 0.0, 0.0}, .torque_n_mm = {}, .is_off = false};
    ASSERT_TRUE(arm.says_hello(1000 * ms));
    ASSERT_TRUE(arm.says_pose(1001 * ms));
    arm.says_goodbye(1002 * ms);
    ASSERT_TRUE(other.says_hello(1002 * ms));
    for (std::uint64_t at = 1003; at < 1070; ++at) {
        host.take(other.pose([](omb_pose& pose) { pose.kept_ns = 0; }), {2}, at * ms);
        const bool is_acted_on = at >= 1051;
        EXPECT_EQ(host.has_fresh_pose(), is_acted_on) << at;
        const BridgeMessage answer = host.answer(at * ms, wanted);
        omb_force force{};
        omb_get_force(answer.data(), &force);
        EXPECT_EQ(force.is_off, is_acted_on ? 0U : 1U) << at;
        const omb_key none{};
        ASSERT_NE(omb_get_header(answer.data(), answer.size(), &none, &other.welcome), 0);
    }
}

TEST(BridgeHost, OneWhoJoinsBeforeTheSessionIsBuiltKeepsNoOtherArmOut) {
    BridgeHost host = some_host();
    omb_arm small = testing::some_arm();
    small.max_force_n = 1.0;
    LyingArm stranger(host, {6});
    ASSERT_TRUE(stranger.says_hello(1000 * ms, small));
    ASSERT_TRUE(stranger.says_pose(1001 * ms));
    LyingArm arm(host, {1});
    EXPECT_FALSE(arm.says_hello(1100 * ms));
    ASSERT_TRUE(arm.says_hello(1300 * ms));
    ASSERT_TRUE(arm.says_pose(1301 * ms));
    EXPECT_EQ(host.arm()->max_force_n, 3.0);
    host.keep_arm();  // force and coupling are built on it
    EXPECT_FALSE(stranger.says_hello(2000 * ms, small));
    EXPECT_THAT(host.refusal(), ::testing::HasSubstr("another arm"));
    EXPECT_TRUE(arm.says_hello(2000 * ms));
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

TEST(BridgeHost, TakesThePosesOfAnArmWhoseClockGoesInSteps) {
    BridgePair bridge;
    bridge.arm_clock_ns = [](std::uint64_t now_ns) { return (now_ns / 15'600'000 + 1) * 15'600'000; };
    bridge.exchange(200);
    EXPECT_EQ(bridge.host.counts().late, 0U);
    EXPECT_GT(bridge.host.counts().poses, 100U);
}

TEST(BridgeHost, TakesNoPoseForFreshBecauseTheArmsClockSaysSo) {
    using Clock = std::function<std::uint64_t(std::uint64_t)>;
    const std::uint64_t begin_ns = 1'000'000'000;
    std::vector<Clock> clocks;
    for (const double rate : {0.0, 0.2, 0.5, 1.0, 2.0, 5.0})
        clocks.emplace_back([=](std::uint64_t now_ns) {
            return begin_ns + static_cast<std::uint64_t>(rate * static_cast<double>(now_ns - begin_ns));
        });
    clocks.emplace_back([](std::uint64_t now_ns) { return now_ns % 100'000'000; });  // wraps
    clocks.emplace_back(
        [](std::uint64_t now_ns) { return now_ns / 300'000'000 % 2 * 5'000'000'000 + now_ns; });
    for (std::size_t which = 0; which < clocks.size(); ++which) {
        // The server stands still for longer and longer; then it finds the arm's messages of that time.
        for (const int away_ms : {20, 120, 500, 3000}) {
            BridgePair bridge;
            bridge.arm_clock_ns = clocks[which];
            bridge.exchange(300);
            std::vector<std::pair<Datagram, std::uint64_t>> under_way;
            bridge.pass_on = [&](const Datagram& one) {
                under_way.emplace_back(one, bridge.now_ns);
                return Datagrams{};
            };
            bridge.exchange(away_ms);
            for (const auto& [said, at_ns] : under_way) {
                bridge.deliver(said, bridge.peer);
                if (!bridge.host.has_fresh_pose()) continue;
                ASSERT_LE(bridge.now_ns - at_ns, 100 * ms) << "clock " << which;
                ASSERT_LE(bridge.host.said_ns(), at_ns + BridgeHost::longest_kept_ns) << "clock " << which;
            }
        }
    }
}

TEST(BridgeHost, WithAKeyHearsOnlyWhoHasIt) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "key") << std::string(40, 'k');
    std::filesystem::permissions(folder / "key", std::filesystem::perms::owner_read);
    std::ofstream(folder / "other") << std::string(40, 'o');
    std::filesystem::permissions(folder / "other", std::filesystem::perms::owner_read);
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

// An eavesdropper may send again any message of this session or one before.
TEST(BridgeHost, WithAKeyNothingThatWasSaidMovesItAgain) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "key") << std::string(40, 'k');
    std::filesystem::permissions(folder / "key", std::filesystem::perms::owner_read);
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
