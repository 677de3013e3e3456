// Both ends of a bridge in one thread and with a clock of its own: the header's side on a real socket, the
// server's side as a BridgeHost. Messages under way can be lost, doubled, kept back or changed.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <functional>
#include <vector>

#include "devices/bridge/bridge_host.h"
#include "devices/bridge/datagram_socket.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {

inline omb_arm some_arm() {
    omb_arm arm{};
    std::memcpy(arm.name, "test arm", 9);
    arm.max_force_n = 3.0;
    arm.max_torque_n_mm = 100.0;
    arm.max_stiffness_n_per_mm = 1.5;
    arm.apparent_mass_kg = 0.05;
    for (int axis = 0; axis < 3; ++axis) {
        arm.workspace_min_mm[axis] = -80.0;
        arm.workspace_max_mm[axis] = 80.0;
    }
    return arm;
}

inline omb_pose ready_pose() {
    omb_pose pose{};
    pose.quaternion[0] = 1.0;
    pose.status = OMB_READY | OMB_HAS_ORIENTATION;
    return pose;
}

class BridgePair {
  public:
    using Datagram = std::vector<std::uint8_t>;

    explicit BridgePair(const omb_arm& arm = some_arm(), const omb_key& server_key = {},
                        const char* arm_key_file = nullptr)
        : socket_(BridgePath{folder_ / "arm"}),
          host(server_key, [this] { return ++random_ * 0x9e3779b97f4a7c15U; }) {
        const std::string address = "unix:" + (folder_ / "arm").string();
        EXPECT_EQ(omb_open(&link, address.c_str(), arm_key_file, &arm), 0) << link.error;
    }
    ~BridgePair() { omb_close(&link); }

    /// A millisecond later both have spoken.
    omb_state exchange() {
        now_ns += 1'000'000;
        const omb_state state = say();
        answer();
        return state;
    }
    /// The arm sends now, and the server receives the datagrams that `pass_on` returns for each.
    omb_state say() {
        const omb_state state = omb_exchange_at(&link, &pose, &force, arm_clock_ns(now_ns));
        if (is_server_stopped) return state;
        Datagram buffer(OMB_MESSAGE_BYTES + 1);
        PeerAddress from;
        bool is_fresh = false;
        while (const auto bytes = socket_.receive(buffer, from, 0)) {
            const Datagram said(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*bytes));
            sent.push_back(said);
            for (const Datagram& one : pass_on(said)) {
                hear(one, from);
                is_fresh = is_fresh || host.has_fresh_pose();
            }
        }
        has_fresh_pose = is_fresh;
        return state;
    }
    /// The server answers.
    void answer() {
        if (host.awaits_answer()) send_back(host.answer(now_ns, wanted));
    }
    /// Delivers the datagram as if it came from there.
    void deliver(const Datagram& datagram, const PeerAddress& from) {
        hear(datagram, from);
        answer();
    }
    void exchange(int times) {
        for (int i = 0; i < times; ++i) exchange();
    }
    /// To the arm, past pass_back.
    void send_to_arm(const Datagram& datagram) { socket_.send(datagram, peer); }
    double given_n() const { return omb_length(force.force_n); }

  private:
    void hear(const Datagram& datagram, const PeerAddress& from) {
        peer = from;
        const auto welcome = host.take(datagram, from, now_ns);
        if (host.has_fresh_pose()) ++fresh_poses;
        if (welcome) send_back(*welcome);
    }
    void send_back(const BridgeMessage& message) {
        answers.emplace_back(message.begin(), message.end());
        for (const Datagram& one : pass_back(answers.back())) socket_.send(one, peer);
    }

    TemporaryFolder folder_;
    DatagramSocket socket_;
    std::uint64_t random_ = 1;

  public:
    BridgeHost host;
    omb_link link{};
    omb_pose pose = ready_pose();
    omb_force force{};
    BridgeForce wanted{.force_n = {0.0, 0.0, 1.0}, .torque_n_mm = {}, .is_off = false};
    std::function<std::vector<Datagram>(const Datagram&)> pass_on = [](const Datagram& one) {
        return std::vector<Datagram>{one};
    };
    std::function<std::vector<Datagram>(const Datagram&)> pass_back = [](const Datagram& one) {
        return std::vector<Datagram>{one};
    };
    std::vector<Datagram> sent;     // by the arm
    std::vector<Datagram> answers;  // the server's
    PeerAddress peer;
    int fresh_poses = 0;
    bool has_fresh_pose = false;  ///< among what was heard last
    bool is_server_stopped = false;
    std::uint64_t now_ns = 1'000'000'000;
    /// The arm's clock at a given time of this clock.
    std::function<std::uint64_t(std::uint64_t)> arm_clock_ns = [](std::uint64_t ns) { return ns; };
};

}  // namespace osteomill::testing
