// One TCP connection, plain or under TLS, with the same calls for both; and why it failed, in words.
//
// A stream owns the bytes under way in both directions, so an owner that drops it need not wait for them. All
// calls and handlers are on the thread of the socket's io_context; handlers keep the stream alive.
#pragma once

#include <openssl/ssl.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace osteomill {

// Reason why a TLS connection failed, as a sentence about the other end ("it shows no certificate").

/// Why the handshake on `tls` ended with `error`.
std::string describe_handshake_failure(const SSL* tls, const boost::system::error_code& error);

/// Whether the other end sent a TLS alert: it is the one that refuses. With TLS 1.3 a client hears of that
/// only in place of the first data.
bool is_refusal(const boost::system::error_code& error);

/// Whether it would end the same way again with the same certificates at both ends.
bool is_about_certificates(const boost::system::error_code& error);

/// A description of any error of a stream.
std::string describe_stream_error(const boost::system::error_code& error);

class TlsContext;

class Stream {
  public:
    /// The bytes that arrived; the view is valid until the handler returns.
    using ReadHandler = std::function<void(boost::system::error_code, std::span<const std::uint8_t>)>;
    using WriteHandler = std::function<void(boost::system::error_code)>;
    /// `failure`: empty, or why there is no connection, as a sentence about the other end.
    using HandshakeHandler = std::function<void(const std::string& failure)>;

    virtual ~Stream() = default;

    /// First of all, and once. Without TLS it succeeds at once, from within.
    virtual void handshake(HandshakeHandler handler) = 0;
    /// One at a time.
    virtual void read(ReadHandler handler) = 0;
    /// All of it; one at a time. The system accepts all bytes as soon as it has space for a part of them.
    virtual void write(std::string bytes, WriteHandler handler) = 0;
    /// When most of the written bytes are on their way (see TCP_NOTSENT_LOWAT), or there is an error, which
    /// the next write reports. Not while a write is under way.
    virtual void wait_until_taken(std::function<void()> handler) = 0;
    /// Nothing more will be written. Says so to TCP alone: a session ends with a goodbye of its own, which
    /// TLS protects as it does all else.
    void end_writing();
    /// Handlers that wait are called with an error.
    void close();

    /// ADDRESS:PORT of the other end; behind it, once TLS has checked it, the name in its certificate.
    virtual std::string peer() = 0;
    /// The whole subject of that certificate, in the form of RFC 2253 ("CN=viewer"); empty without TLS.
    virtual std::string subject() { return {}; }
    /// Whether that certificate has been revoked since, as far as the list is known here.
    virtual bool is_revoked() { return false; }
    /// After a handshake that failed: whether it is for a certificate's sake, and to try again is no use.
    virtual bool is_refused() const { return false; }
    /// For its options.
    virtual boost::asio::ip::tcp::socket& socket() = 0;
};

/// ADDRESS:PORT of the other end; "a client" if it has gone.
std::string describe_end(const boost::asio::ip::tcp::socket& socket);

/// The serving end of a connection that was accepted. `tls`: null for none; outlives the stream.
std::shared_ptr<Stream> serving_stream(boost::asio::ip::tcp::socket socket, TlsContext* tls,
                                       std::size_t read_bytes);

/// The other end. Under TLS the server must show a certificate for `host`, a name or an address.
std::shared_ptr<Stream> connecting_stream(boost::asio::ip::tcp::socket socket, TlsContext* tls,
                                          const std::string& host, std::size_t read_bytes);

}  // namespace osteomill
