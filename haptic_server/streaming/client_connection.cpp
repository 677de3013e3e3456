#include "haptic_server/streaming/client_connection.h"

#include <linux/sockios.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>

#include <boost/asio/detail/socket_option.hpp>
#include <boost/asio/error.hpp>
#include <chrono>

#include "common/net/stream.h"
#include "common/wire/frame.h"

namespace osteomill {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

/// The bytes that the system may hold for one client on top of the frame under way. By default it grows to
/// megabytes, seconds of frames: a slow client would see old news and OutgoingFrames would never learn that
/// it is slow. Enough for 60 MB/s at a round trip of 4 ms.
constexpr int send_buffer_bytes = 256 * 1024;

/// The part of that which may wait behind the bytes in flight. So over a slow link a frame is made late
/// rather than sent old: half a second at 64 kbit/s, while the send buffer would hold half a minute.
constexpr int most_unsent_bytes = 4 * 1024;
using UnsentBytes = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;

/// A client that has taken nothing for so long has gone, or stands still: it may come again. The system would
/// keep its place for a quarter of an hour.
constexpr std::chrono::milliseconds longest_stall{30'000};
using StallTimeout = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;

/// Whether a client begins as TLS does: with a record of kind 22, version 3.x. Read as a frame, that would
/// have 22 bytes and begin with field number 0, which protobuf does not have.
bool is_tls_greeting(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 2 && bytes[0] == 0x16 && bytes[1] == 0x03;
}

}  // namespace

ClientConnection::ClientConnection(std::shared_ptr<Stream> stream, OutgoingFrames outgoing)
    : stream_(std::move(stream)), outgoing_(std::move(outgoing)), peer_(stream_->peer()) {}

void ClientConnection::start(Callbacks callbacks) {
    callbacks_ = std::move(callbacks);
    error_code ignored;  // a socket without these still works
    asio::ip::tcp::socket& socket = stream_->socket();
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::keep_alive(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(send_buffer_bytes), ignored);
    socket.set_option(UnsentBytes(most_unsent_bytes), ignored);
    socket.set_option(StallTimeout(static_cast<int>(longest_stall.count())), ignored);
    read();
    pump();
}

void ClientConnection::serve() {
    is_served_ = true;
    pump();
}

void ClientConnection::show(SessionState state, bool with_checksum) {
    outgoing_.request_state(std::move(state), with_checksum);
    if (outgoing_.has_sent_all()) answers_.still_true(std::chrono::steady_clock::now());
    pump();
}

void ClientConnection::pump() {
    if (is_closed_ || is_writing_ || (has_said_hello_ && !is_served_)) return;
    has_said_hello_ = true;
    const std::uint64_t sent = outgoing_.newest_state();
    std::optional<std::string> frame = outgoing_.next(pace_.most_bytes());
    if (outgoing_.newest_state() != sent)
        answers_.sent(outgoing_.newest_state(), std::chrono::steady_clock::now());
    if (!frame) {
        // The client closes when it has read goodbye. Closing first could reset the connection and destroy
        // data that it has not read yet.
        if (outgoing_.is_finished()) stream_->end_writing();
        return;
    }
    is_writing_ = true;
    const std::size_t bytes = frame->size();
    const auto began = std::chrono::steady_clock::now();
    stream_->write(std::move(*frame), [self = shared_from_this(), bytes, began](error_code error) {
        if (error) return self->close("left: " + describe_stream_error(error), false);
        if (self->callbacks_.on_sent) self->callbacks_.on_sent(bytes);
        // The next one is not made before this one is on its way: it would be old when its turn comes.
        self->stream_->wait_until_taken([self, bytes, began] {
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
            self->pace_.wrote(bytes, took.count());
            self->is_writing_ = false;
            self->pump();
        });
    });
}

std::chrono::steady_clock::duration ClientConnection::has_had_end(std::chrono::steady_clock::time_point now) {
    int on_its_way = 1;
    const bool is_all_there = outgoing_.is_finished() && !is_writing_ &&
                              ioctl(stream_->socket().native_handle(), SIOCOUTQ, &on_its_way) == 0 &&
                              on_its_way == 0;
    if (!is_all_there) return {};
    if (!had_end_at_) had_end_at_ = now;
    return now - *had_end_at_;
}

void ClientConnection::close(const std::string& line, bool is_fault) {
    if (is_closed_) return;
    is_closed_ = true;
    stream_->close();
    // The callbacks hold on to the owner of this session: let go of them.
    const Callbacks callbacks = std::exchange(callbacks_, {});
    if (callbacks.on_closed) callbacks.on_closed(line, is_fault);
}

void ClientConnection::read() {
    stream_->read([self = shared_from_this()](error_code error, std::span<const std::uint8_t> arrived) {
        if (self->is_closed_) return;
        if (error == asio::error::eof) return self->close("left", false);
        if (error) return self->close("left: " + describe_stream_error(error), false);
        self->take(arrived);
    });
}

void ClientConnection::take(std::span<const std::uint8_t> arrived) {
    if (last_sequence_ == 0 && is_tls_greeting(arrived))
        return close("dropped: it speaks TLS, and this server runs without", true);
    decoder_.append(arrived);
    while (const auto message = decoder_.next()) {
        if (!messages_.take(std::chrono::steady_clock::now()))
            return close("dropped: it sent more than " +
                             std::to_string(static_cast<int>(most_messages_per_s)) + " messages a second",
                         true);
        v2::ClientFrame frame;
        if (!parse_message(*message, frame))
            return close("dropped: it sent a frame that is no message", true);
        if (frame.sequence() != last_sequence_ + 1)
            return close("dropped: frame " + std::to_string(frame.sequence()) + " came after " +
                             std::to_string(last_sequence_),
                         true);
        last_sequence_ = frame.sequence();
        if (frame.has_goodbye()) return close("left", false);
        if (const auto error = callbacks_.on_message(frame)) return close("dropped: " + error->line, true);
    }
    if (!decoder_.error().empty()) return close("dropped: " + decoder_.error(), true);
    read();
}

}  // namespace osteomill
