// Connections between being accepted and being a client: the TLS handshake, with a deadline for each and a
// bound on how many there are. Without TLS they are clients at once.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "common/net/stream.h"

namespace osteomill {

class Handshakes {
  public:
    /// When there are more, the oldest gives way: an honest one is over long before.
    static constexpr std::size_t most_at_once = 16;

    struct Callbacks {
        std::function<void(std::shared_ptr<Stream>)> on_done;
        /// `why` is in words about the other end.
        std::function<void(const std::string& peer, const std::string& why)> on_failed;
    };

    /// `tls`: null for none. It and `io` outlive this.
    Handshakes(boost::asio::io_context& io, TlsContext* tls, std::chrono::milliseconds deadline,
               Callbacks callbacks);

    void begin(boost::asio::ip::tcp::socket socket);
    /// Hangs up on all that are under way; nobody is told.
    void cancel() { under_way_.clear(); }

  private:
    /// Closes what has not been handed on.
    struct Handshake {
        Handshake(std::shared_ptr<Stream> its_stream, boost::asio::io_context& io)
            : stream(std::move(its_stream)), timer(io) {}
        ~Handshake() {
            if (stream) stream->close();
        }
        Handshake(const Handshake&) = delete;
        Handshake& operator=(const Handshake&) = delete;

        std::shared_ptr<Stream> stream;
        boost::asio::steady_timer timer;
    };
    using Id = std::uint64_t;

    void fail(Id id, const std::string& why);

    boost::asio::io_context& io_;
    TlsContext* tls_;
    const std::chrono::milliseconds deadline_;
    Callbacks callbacks_;
    Id last_id_ = 0;
    std::map<Id, Handshake> under_way_;
};

}  // namespace osteomill
