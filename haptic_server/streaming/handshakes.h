// Connections between being accepted and being a client: the TLS handshake, with a deadline for each and a
// bound on how many there are. Without TLS they wait for their hello at once.
//
// A silent connection is a socket and a timer; TLS, which costs a hundred times as much, begins with the
// first byte. ConnectionQuota says which connection goes when there are too many.
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
#include "haptic_server/streaming/connection_quota.h"

namespace osteomill {

class Handshakes {
  public:
    struct Callbacks {
        std::function<void(std::shared_ptr<Stream>)> on_done;
        /// `why` is a sentence about the other end.
        std::function<void(const std::string& peer, const std::string& why)> on_failed;
    };

    /// `tls`: null for none. It and `io` outlive this. `most_at_once`: under TLS.
    Handshakes(boost::asio::io_context& io, TlsContext* tls, std::chrono::milliseconds deadline,
               Callbacks callbacks, std::size_t most_at_once = unidentified_quota());

    void begin(boost::asio::ip::tcp::socket socket);
    /// Closes all that are under way, silently.
    void cancel();

  private:
    /// Closes connections that were not passed on.
    struct Handshake {
        Handshake(boost::asio::ip::tcp::socket its_socket, boost::asio::io_context& io)
            : socket(std::move(its_socket)), timer(io) {}
        ~Handshake() {
            if (stream) stream->close();
        }
        Handshake(const Handshake&) = delete;
        Handshake& operator=(const Handshake&) = delete;

        boost::asio::ip::tcp::socket socket;  // until the first byte has come
        std::shared_ptr<Stream> stream;       // from then on
        boost::asio::steady_timer timer;
    };
    using Id = ConnectionQuota::Id;

    void shake_hands(Id id);
    void fail(Id id, const std::string& why);

    boost::asio::io_context& io_;
    TlsContext* tls_;
    const std::chrono::milliseconds deadline_;
    Callbacks callbacks_;
    Id last_id_ = 0;
    std::map<Id, Handshake> under_way_;
    ConnectionQuota quota_;  // for connections that have not shaken hands yet
};

}  // namespace osteomill
