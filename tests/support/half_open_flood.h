// Attack on a server's places for handshakes: it connects at a given rate, sends nothing, and stays.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <thread>

namespace osteomill::testing {

class HalfOpenFlood {
  public:
    HalfOpenFlood(std::uint16_t port, double per_s, const std::string& from = "127.0.0.1",
                  const std::string& to = "127.0.0.1")
        : from_(address_of(from, 0)), to_(address_of(to, port)), per_s_(per_s), thread_([this] { run(); }) {}
    ~HalfOpenFlood() {
        is_over_ = true;
        thread_.join();
        for (const int held : held_) hang_up(held);
    }
    HalfOpenFlood(const HalfOpenFlood&) = delete;
    HalfOpenFlood& operator=(const HalfOpenFlood&) = delete;

    /// Connections begun a second, since the start: fewer than requested if the machine is busy.
    double rate_per_s() const {
        const std::chrono::duration<double> time = Clock::now() - began_;
        return static_cast<double>(begun_) / time.count();
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// More than a server keeps, fewer than a process may have open.
    static constexpr std::size_t most_held = 700;

    static sockaddr_in address_of(const std::string& text, std::uint16_t port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        ::inet_pton(AF_INET, text.c_str(), &address.sin_addr);
        return address;
    }
    /// At once, so that no port is kept for it.
    static void hang_up(int socket) {
        const linger at_once{.l_onoff = 1, .l_linger = 0};
        ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
        ::close(socket);
    }
    void run() {
        while (!is_over_) {
            const std::chrono::duration<double> time = Clock::now() - began_;
            // A backlog after delays of a busy machine is not sent at once, which would be another attack.
            due_ = std::max(due_, time.count() * per_s_ - 0.05 * per_s_);
            if (due_ > time.count() * per_s_) {
                std::this_thread::sleep_for(std::chrono::microseconds(500));
                continue;
            }
            due_ += 1.0;
            connect();
        }
    }
    void connect() {
        const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
        if (socket < 0) return;
        ::bind(socket, reinterpret_cast<const sockaddr*>(&from_), sizeof from_);
        ::connect(socket, reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
        held_.push_back(socket);
        ++begun_;
        if (held_.size() <= most_held) return;
        hang_up(held_.front());
        held_.pop_front();
    }

    const sockaddr_in from_;
    const sockaddr_in to_;
    const double per_s_;
    const Clock::time_point began_ = Clock::now();
    double due_ = 0.0;
    std::deque<int> held_;
    std::atomic<std::uint64_t> begun_{0};
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

}  // namespace osteomill::testing
