// Proxy between a client and a server, which may change or drop the server's frames.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"

namespace osteomill::testing {

class FrameProxy {
  public:
    /// Called on the proxy's thread: may change a frame; false drops it.
    using Meddle = std::function<bool(v2::ServerFrame&)>;

    FrameProxy(std::uint16_t server_port, Meddle meddle)
        : server_port_(server_port), meddle_(std::move(meddle)) {
        accept();
        thread_ = std::thread([this] { io_.run(); });
    }
    ~FrameProxy() {
        io_.stop();
        thread_.join();
    }
    FrameProxy(const FrameProxy&) = delete;
    FrameProxy& operator=(const FrameProxy&) = delete;

    std::uint16_t port() const { return port_; }

  private:
    using tcp = boost::asio::ip::tcp;
    using error_code = boost::system::error_code;

    void accept() {
        acceptor_.async_accept([this](error_code error, tcp::socket client) {
            if (error) return;
            client_ = std::move(client);
            server_ = tcp::socket(io_);
            decoder_ = {};
            server_.connect({boost::asio::ip::address_v4::loopback(), server_port_}, error);
            from_client();
            from_server();
            accept();
        });
    }
    void from_client() {
        client_.async_read_some(boost::asio::buffer(asked_), [this](error_code error, std::size_t bytes) {
            if (error) return hang_up();
            boost::asio::write(server_, boost::asio::buffer(asked_, bytes), error);
            from_client();
        });
    }
    void from_server() {
        server_.async_read_some(boost::asio::buffer(said_), [this](error_code error, std::size_t bytes) {
            if (error) return hang_up();
            decoder_.append(std::span(said_).first(bytes));
            while (const auto message = decoder_.next()) {
                auto frame = std::get<v2::ServerFrame>(open_frame(*message));
                if (!meddle_(frame)) continue;
                frame.clear_frame_checksum();
                std::string passed_on;
                append_sealed_frame(frame, passed_on);
                boost::asio::write(client_, boost::asio::buffer(passed_on), error);
            }
            from_server();
        });
    }
    void hang_up() {
        error_code ignored;
        client_.close(ignored);
        server_.close(ignored);
    }

    std::uint16_t server_port_;
    Meddle meddle_;
    boost::asio::io_context io_{1};
    tcp::acceptor acceptor_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
    const std::uint16_t port_ = acceptor_.local_endpoint().port();
    tcp::socket client_{io_};
    tcp::socket server_{io_};
    FrameDecoder decoder_;
    std::array<std::uint8_t, 65536> said_{};
    std::array<std::uint8_t, 65536> asked_{};
    std::thread thread_;
};

}  // namespace osteomill::testing
