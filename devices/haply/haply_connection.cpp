#include "devices/haply/haply_connection.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

namespace osteomill {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

}  // namespace

struct HaplyConnection::Socket {
    asio::io_context context{1};
    websocket::stream<asio::ip::tcp::socket> stream{context};
    beast::flat_buffer buffer{longest_message};
    std::size_t taken = 0;  // bytes of the buffer that the caller has read
    bool is_open = false;
    bool is_reading = false;   // a read is under way
    bool has_message = false;  // one has ended, and its data were not read

    /// Until `is_done`, or too late.
    template <typename Condition>
    bool run(std::chrono::milliseconds longest, Condition is_done) {
        const auto end = Clock::now() + longest;
        while (!is_done()) {
            const auto left = end - Clock::now();
            if (left <= Clock::duration::zero()) return false;
            if (context.stopped()) context.restart();
            context.run_one_for(left);
        }
        return true;
    }
    /// Operations under way end at once, with an error.
    void close() {
        boost::system::error_code ignored;
        stream.next_layer().close(ignored);
        is_open = false;
        if (context.stopped()) context.restart();
        context.poll();
    }
};

HaplyConnection::HaplyConnection() : socket_(std::make_unique<Socket>()) {}

HaplyConnection::~HaplyConnection() {
    socket_->close();
}

bool HaplyConnection::open(const ListenAddress& service, std::chrono::milliseconds longest) {
    std::optional<boost::system::error_code> connected;
    std::optional<boost::system::error_code> greeted;
    const asio::ip::tcp::endpoint endpoint(asio::ip::make_address(service.address), service.port);
    auto& stream = socket_->stream;
    stream.next_layer().async_connect(endpoint, [&](boost::system::error_code error) { connected = error; });
    if (!socket_->run(longest, [&] { return connected.has_value(); }) || *connected) {
        socket_->close();
        return false;
    }
    boost::system::error_code ignored;
    stream.next_layer().set_option(asio::ip::tcp::no_delay(true), ignored);
    stream.read_message_max(longest_message);
    stream.async_handshake(to_text(service), "/", [&](boost::system::error_code error) { greeted = error; });
    if (!socket_->run(longest, [&] { return greeted.has_value(); }) || *greeted) {
        socket_->close();
        return false;
    }
    socket_->is_open = true;
    return true;
}

bool HaplyConnection::is_open() const {
    return socket_->is_open;
}

bool HaplyConnection::send(std::string_view text, std::chrono::milliseconds longest) {
    if (!socket_->is_open) return false;
    std::optional<boost::system::error_code> sent;
    socket_->stream.async_write(asio::buffer(text.data(), text.size()),
                                [&](boost::system::error_code error, std::size_t) { sent = error; });
    if (!socket_->run(longest, [&] { return sent.has_value(); }) || *sent) {
        socket_->close();
        return false;
    }
    return true;
}

std::optional<std::string_view> HaplyConnection::receive(std::chrono::milliseconds longest) {
    Socket& socket = *socket_;
    if (!socket.is_open) return std::nullopt;
    socket.buffer.consume(socket.taken);
    socket.taken = 0;
    if (!socket.is_reading && !socket.has_message) {
        socket.is_reading = true;
        socket.stream.async_read(socket.buffer, [&socket](boost::system::error_code error, std::size_t) {
            socket.is_reading = false;
            socket.has_message = !error;
            if (error) socket.is_open = false;
        });
    }
    if (!socket.run(longest, [&] { return !socket.is_reading; }) || !socket.has_message) return std::nullopt;
    socket.has_message = false;
    socket.taken = socket.buffer.size();
    return std::string_view(static_cast<const char*>(socket.buffer.data().data()), socket.taken);
}

}  // namespace osteomill
