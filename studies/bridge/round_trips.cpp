#include "studies/bridge/round_trips.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "devices/bridge/bridge_arm.h"
#include "studies/bridge/private_network.h"

namespace osteomill::study {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto period = std::chrono::milliseconds(1);
constexpr std::size_t settling = 100;
constexpr int longest_wait_ms = 100;

/// Runs `work` on a thread of its own in that namespace, to its end.
void in_namespace(const std::string& name, const std::function<void()>& work) {
    std::exception_ptr failed;
    std::thread([&] {
        try {
            std::optional<PrivateNetwork::Stay> stay;
            if (!name.empty()) stay.emplace(name);
            work();
        } catch (...) {
            failed = std::current_exception();
        }
    }).join();
    if (failed) std::rethrow_exception(failed);
}

BridgeAddress beside(const BridgeAddress& where) {
    if (const auto* path = std::get_if<BridgePath>(&where)) return BridgePath{path->path.string() + "e"};
    ListenAddress udp = std::get<ListenAddress>(where);
    ++udp.port;
    return udp;
}

/// Sends datagrams back, as a thread that does nothing else.
class Echo {
  public:
    explicit Echo(const BridgeAddress& where) : socket_(where) {
        thread_ = std::thread([this] {
            std::array<std::uint8_t, OMB_MESSAGE_BYTES + 1> buffer{};
            PeerAddress from;
            while (!stops_.load(std::memory_order_relaxed))
                if (const auto bytes = socket_.receive(buffer, from, 5))
                    socket_.send(std::span(buffer).first(*bytes), from);
        });
    }
    ~Echo() {
        stops_ = true;
        thread_.join();
    }

  private:
    DatagramSocket socket_;
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

omb_arm some_arm() {
    omb_arm arm{};
    arm.max_force_n = 3.0;
    arm.max_stiffness_n_per_mm = 1.0;
    arm.apparent_mass_kg = 0.05;
    for (double& edge : arm.workspace_max_mm) edge = 1.0;
    return arm;
}

omb_key key_of(bool is_given) {
    omb_key key{};
    const std::array<std::uint8_t, 32> secret{1, 2, 3};
    if (is_given) omb_set_key(&key, secret.data(), secret.size());
    return key;
}

bool waits_for_datagram(omb_link& link) {
    pollfd wait{link.socket, POLLIN, 0};
    return poll(&wait, 1, longest_wait_ms) > 0;
}

double since_us(Clock::time_point began) {
    return std::chrono::duration<double, std::micro>(Clock::now() - began).count();
}

void open_or_throw(omb_link& link, const BridgeAddress& where) {
    const omb_arm arm = some_arm();
    if (omb_open(&link, to_text(where).c_str(), nullptr, &arm) != 0) throw std::runtime_error(link.error);
}

/// A pose, and the wait for its answer. Nothing if none comes.
std::optional<double> bridge_trip_us(omb_link& link) {
    omb_pose pose{};
    pose.status = OMB_READY;
    omb_force force;
    const auto began = Clock::now();
    omb_exchange(&link, &pose, &force);
    const std::uint64_t said = link.sequence;
    while (waits_for_datagram(link)) {
        std::array<std::uint8_t, OMB_MESSAGE_BYTES + 1> message{};
        const auto bytes = recv(link.socket, message.data(), message.size(), 0);
        if (bytes > 0) omb_hear(&link, message.data(), static_cast<std::size_t>(bytes), omb_now_ns());
        if (link.newest.echo_sequence == said) return since_us(began);
    }
    return std::nullopt;
}

std::optional<double> echo_trip_us(omb_link& link) {
    std::array<std::uint8_t, OMB_MESSAGE_BYTES> message{};
    const auto began = Clock::now();
    if (send(link.socket, message.data(), message.size(), 0) < 0) return std::nullopt;
    if (!waits_for_datagram(link) || recv(link.socket, message.data(), message.size(), 0) < 0)
        return std::nullopt;
    return since_us(began);
}

}  // namespace

RoundTrips measure_round_trips(const Ends& ends, double seconds) {
    std::unique_ptr<BridgeArm> server;
    std::unique_ptr<Echo> echo;
    in_namespace(ends.server_namespace, [&] {
        BridgeArm::Parts parts{.key = key_of(ends.has_key), .random = [] {
                                   std::random_device random;
                                   return std::uint64_t{random()} + 1;
                               }};
        server = std::make_unique<BridgeArm>(ends.where, std::move(parts));
        echo = std::make_unique<Echo>(beside(ends.where));
    });
    RoundTrips trips;
    in_namespace(ends.arm_namespace, [&] {
        omb_link arm;
        omb_link plain;
        open_or_throw(arm, ends.where);
        open_or_throw(plain, beside(ends.where));
        arm.key = key_of(ends.has_key);
#ifndef _WIN32
        if (plain.own_path[0] != 0) omb_find_unix_server(&plain);
#endif
        omb_pose pose{};
        omb_force force;
        for (int i = 0; i < 1000 && arm.session == 0; ++i) {
            omb_exchange(&arm, &pose, &force);
            std::this_thread::sleep_for(period);
        }
        const auto turns = static_cast<std::size_t>(1000.0 * seconds);
        auto due = Clock::now();
        for (std::size_t turn = 0; turn < turns + settling; ++turn) {
            std::this_thread::sleep_until(due += period);
            const auto bridge_us = bridge_trip_us(arm);
            std::this_thread::sleep_until(due += period);
            const auto echo_us = echo_trip_us(plain);
            if (turn < settling) continue;
            if (bridge_us) trips.bridge_us.push_back(*bridge_us);
            if (echo_us) trips.echo_us.push_back(*echo_us);
        }
        omb_close(&arm);
        omb_close(&plain);
    });
    if (trips.bridge_us.empty() || trips.echo_us.empty())
        throw std::runtime_error(to_text(ends.where) + ": nothing was answered");
    return trips;
}

}  // namespace osteomill::study
