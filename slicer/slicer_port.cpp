#include "slicer/slicer_port.h"

#include <fmt/format.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <deque>
#include <stdexcept>
#include <utility>

#include "common/igtl/igtl_stream.h"
#include "common/log/log.h"

namespace osteomill {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using boost::system::error_code;

struct SlicerPort::Receiver {
    Receiver(tcp::socket connection, IgtlStream::Sinks sinks)
        : socket(std::move(connection)), held_up(socket.get_executor()), stream(std::move(sinks)) {}

    tcp::socket socket;
    asio::steady_timer held_up;
    IgtlStream stream;
    std::array<std::uint8_t, 4096> read{};
    std::deque<IgtlMessage> unsent{};
};

SlicerPort::SlicerPort(std::uint16_t port, Sinks sinks) : sinks_(std::move(sinks)) {
    const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
    try {
        acceptor_.open(here.protocol());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(here);
        acceptor_.listen();
    } catch (const boost::system::system_error& error) {
        throw std::runtime_error(
            fmt::format("--port {}: cannot listen there: {}; is another osteomill_slicer, or "
                        "a tracker's server, running?",
                        port, error.code().message()));
    }
    accept();
}

SlicerPort::~SlicerPort() = default;

std::uint16_t SlicerPort::port() const {
    return acceptor_.local_endpoint().port();
}

void SlicerPort::run_for(std::chrono::milliseconds time) {
    io_.run_for(time);
    log_.tell_left_out(std::chrono::steady_clock::now());
}

void SlicerPort::say(LogLevel level, const std::string& line) {
    log_.write(level, line, std::chrono::steady_clock::now());
}

bool SlicerPort::takes_more() const {
    return receiver_ != nullptr && receiver_->unsent.empty();
}

void SlicerPort::accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
        if (!error && receiver_) {
            say(LogLevel::warning, "a second connection to the port of 3D Slicer was refused: one is there");
        } else if (!error) {
            receiver_ = std::make_shared<Receiver>(
                std::move(socket),
                IgtlStream::Sinks{
                    .wants = [](const std::string& type, const std::string&) { return type == "STRING"; },
                    .take =
                        [this](const IgtlMessageView& message) {
                            if (auto text = text_of_string_message(message.content))
                                sinks_.said(message.name, *text);
                        },
                    .damaged =
                        [this] { say(LogLevel::warning, "a damaged STRING message was passed over"); }});
            say(LogLevel::info, "3D Slicer has connected");
            read(receiver_);
            sinks_.connected();
        }
        accept();
    });
}

void SlicerPort::read(const std::shared_ptr<Receiver>& receiver) {
    receiver->socket.async_read_some(asio::buffer(receiver->read),
                                     [this, receiver](error_code error, std::size_t count) {
                                         if (receiver != receiver_) return;
                                         if (error) return drop(receiver, "it left");
                                         if (!receiver->stream.feed({receiver->read.data(), count}))
                                             return drop(receiver, "what it sends is no OpenIGTLink");
                                         read(receiver);
                                     });
}

void SlicerPort::send(IgtlMessage message) {
    if (!receiver_) return;
    stamp(message, std::chrono::system_clock::now());
    receiver_->unsent.push_back(std::move(message));
    if (receiver_->unsent.size() == 1) write(receiver_);
}

void SlicerPort::write(const std::shared_ptr<Receiver>& receiver) {
    receiver->held_up.expires_after(longest_held_up);
    receiver->held_up.async_wait([this, receiver](error_code error) {
        if (!error && receiver == receiver_) drop(receiver, "it took nothing for 10 s");
    });
    asio::async_write(receiver->socket, asio::buffer(receiver->unsent.front()),
                      [this, receiver](error_code error, std::size_t) {
                          receiver->held_up.cancel();
                          if (receiver != receiver_) return;
                          if (error) return drop(receiver, "it left");
                          receiver->unsent.pop_front();
                          if (!receiver->unsent.empty()) write(receiver);
                      });
}

void SlicerPort::drop(std::shared_ptr<Receiver> receiver, const char* why) {
    if (receiver != receiver_) return;
    say(LogLevel::info, fmt::format("the connection to 3D Slicer ends: {}", why));
    receiver_.reset();
    error_code ignored;
    receiver->held_up.cancel();
    receiver->socket.close(ignored);
}

}  // namespace osteomill
