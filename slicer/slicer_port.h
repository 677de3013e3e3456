// The port that 3D Slicer connects to: a TCP server on loopback for one receiver. OpenIGTLink has neither
// authentication nor encryption, so no other machine can reach the port.
//
// The connected receiver keeps its place: a newer connection is closed at once, or else any process of this
// machine could displace 3D Slicer. A receiver that reads nothing for 10 s is dropped. The log has a line for
// each connection and its end, one every two seconds at most (rate_limit.h).
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/log/log.h"
#include "common/log/rate_limit.h"
#include "slicer/igtl_messages.h"

namespace osteomill {

class SlicerPort {
  public:
    static constexpr std::chrono::seconds longest_held_up{10};

    struct Sinks {
        std::function<void()> connected;  ///< somebody receives, and has nothing yet
        std::function<void(const std::string& name, const std::string& text)> said;  ///< a STRING message
    };

    /// Listens on 127.0.0.1; 0: a free port. Throws std::runtime_error in one line if it cannot.
    SlicerPort(std::uint16_t port, Sinks sinks);
    ~SlicerPort();
    SlicerPort(const SlicerPort&) = delete;
    SlicerPort& operator=(const SlicerPort&) = delete;

    std::uint16_t port() const;

    /// Takes connections, reads and writes, for at most `time`; calls the sinks.
    void run_for(std::chrono::milliseconds time);

    /// Whether somebody receives and nothing sent before is still waiting, so that a message sent now is not
    /// late.
    bool takes_more() const;
    /// Drops the message if nobody receives.
    void send(IgtlMessage message);

  private:
    struct Receiver;
    void accept();
    void read(const std::shared_ptr<Receiver>& receiver);
    void write(const std::shared_ptr<Receiver>& receiver);
    void drop(std::shared_ptr<Receiver> receiver, const char* why);
    void say(LogLevel level, const std::string& line);

    Sinks sinks_;
    LimitedLog log_{};
    boost::asio::io_context io_{1};
    boost::asio::ip::tcp::acceptor acceptor_{io_};
    std::shared_ptr<Receiver> receiver_{};  // null: nobody
};

}  // namespace osteomill
