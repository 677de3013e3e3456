// A stranger that connects to a server's port: a scan, or a program that stands still.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <cstdint>
#include <string>

#include "common/wire/frame.h"
#include "common/wire/protocol_version.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill::testing {

class Stranger {
  public:
    explicit Stranger(std::uint16_t port) : Stranger("127.0.0.1", port) {}
    Stranger(const std::string& address, std::uint16_t port) {
        boost::system::error_code ignored;  // who is turned away has been there all the same
        socket_.connect({boost::asio::ip::make_address(address), port}, ignored);
    }
    void say(const std::string& bytes) {
        boost::system::error_code ignored;
        boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
    }
    /// Sends a client's greeting; never reads the answer.
    void greet() {
        v2::ClientFrame frame;
        frame.set_sequence(1);
        frame.mutable_hello()->set_protocol_major(protocol_major);
        std::string bytes;
        append_frame(frame, bytes);
        say(bytes);
    }

  private:
    boost::asio::io_context io_;
    boost::asio::ip::tcp::socket socket_{io_};
};

}  // namespace osteomill::testing
