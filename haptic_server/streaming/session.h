// One client's socket: writes what its feed says, one frame at a time, and reads what the client sends.
#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "common/wire/frame.h"
#include "haptic_server/streaming/client_feed.h"

namespace osteomill {

/// Lives until its socket is closed. All calls and callbacks are on the thread of the socket's io_context.
class Session : public std::enable_shared_from_this<Session> {
  public:
    struct Callbacks {
        /// A message from the client; an error if it makes no sense, which drops the client.
        std::function<std::optional<WireError>(const v1::ClientFrame&)> on_message;
        /// Once, last: the line says why it ended, and `is_fault` whether the client is to blame.
        std::function<void(const std::string& line, bool is_fault)> on_closed;
    };

    Session(boost::asio::ip::tcp::socket socket, ClientFeed feed);

    void start(Callbacks callbacks);
    ClientFeed& feed() { return feed_; }
    /// Writes the next frame, unless one is under way; call after the feed has been given something to say.
    void pump();
    /// Cuts the connection.
    void close(const std::string& line, bool is_fault);
    /// ADDRESS:PORT of the client.
    const std::string& peer() const { return peer_; }

  private:
    void read();
    void take(std::size_t bytes);

    boost::asio::ip::tcp::socket socket_;
    ClientFeed feed_;
    Callbacks callbacks_;
    std::string peer_;
    std::string under_way_;
    bool is_writing_ = false;
    bool is_closed_ = false;

    std::array<std::uint8_t, 4096> arrived_{};
    FrameDecoder decoder_;
    std::uint64_t last_sequence_ = 0;
};

}  // namespace osteomill
