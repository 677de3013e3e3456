#include "haptic_server/streaming/session.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <sstream>

namespace osteomill {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

/// What the system may hold for one client on top of the frame under way. By default it grows to megabytes,
/// seconds of frames: a slow client would see old news and the feed would never learn that it is slow. Enough
/// for 60 MB/s at a round trip of 4 ms.
constexpr int send_buffer_bytes = 256 * 1024;

std::string describe_peer(const asio::ip::tcp::socket& socket) {
    error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    if (error) return "a client";
    std::ostringstream text;
    text << endpoint;
    return text.str();
}

}  // namespace

Session::Session(asio::ip::tcp::socket socket, ClientFeed feed)
    : socket_(std::move(socket)), feed_(std::move(feed)), peer_(describe_peer(socket_)) {}

void Session::start(Callbacks callbacks) {
    callbacks_ = std::move(callbacks);
    error_code ignored;  // a socket without these still works
    socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
    socket_.set_option(asio::socket_base::keep_alive(true), ignored);
    socket_.set_option(asio::socket_base::send_buffer_size(send_buffer_bytes), ignored);
    read();
    pump();
}

void Session::pump() {
    if (is_closed_ || is_writing_) return;
    std::optional<std::string> frame = feed_.next();
    if (!frame) {
        // The client closes when it has read goodbye. Closing first could reset the connection and destroy
        // what it has not read yet.
        error_code ignored;
        if (feed_.is_finished()) socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        return;
    }
    under_way_ = std::move(*frame);
    is_writing_ = true;
    asio::async_write(socket_, asio::buffer(under_way_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) return self->close("left: " + error.message(), false);
                          self->pump();
                      });
}

void Session::close(const std::string& line, bool is_fault) {
    if (is_closed_) return;
    is_closed_ = true;
    error_code ignored;
    socket_.close(ignored);
    // The callbacks hold on to whoever holds this session: let go of them.
    const Callbacks callbacks = std::exchange(callbacks_, {});
    if (callbacks.on_closed) callbacks.on_closed(line, is_fault);
}

void Session::read() {
    socket_.async_read_some(asio::buffer(arrived_),
                            [self = shared_from_this()](error_code error, std::size_t bytes) {
                                if (self->is_closed_) return;
                                if (error == asio::error::eof) return self->close("left", false);
                                if (error) return self->close("left: " + error.message(), false);
                                self->take(bytes);
                            });
}

void Session::take(std::size_t bytes) {
    decoder_.append(std::span(arrived_).first(bytes));
    while (const auto message = decoder_.next()) {
        v1::ClientFrame frame;
        if (!frame.ParseFromArray(message->data(), static_cast<int>(message->size())))
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
