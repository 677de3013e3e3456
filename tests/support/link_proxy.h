// A bad link between clients and a server: slow, late, cut or dropped. Bytes pass as they are, in order.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace osteomill::testing {

struct LinkQuality {
    std::chrono::milliseconds delay{0};   ///< each way
    std::chrono::milliseconds jitter{0};  ///< up to so much more, at random
    double bytes_per_s = 1e9;             ///< each way
};

class LinkProxy {
  public:
    explicit LinkProxy(std::uint16_t server_port, const LinkQuality& quality = {})
        : server_port_(server_port), quality_(quality) {
        accept();
        thread_ = std::thread([this] { io_.run(); });
    }
    ~LinkProxy() {
        io_.stop();
        thread_.join();
    }
    LinkProxy(const LinkProxy&) = delete;
    LinkProxy& operator=(const LinkProxy&) = delete;

    std::uint16_t port() const { return port_; }
    std::uint64_t bytes_to_clients() const { return bytes_to_clients_; }

    /// From now on data pass with these delays, from client to server and back.
    void delay(std::chrono::milliseconds to_server, std::chrono::milliseconds to_client) {
        delay_to_server_ms_ = to_server.count();
        delay_to_client_ms_ = to_client.count();
    }

    /// Nothing passes any more, without notice; sent data wait.
    void cut() { is_cut_ = true; }
    void heal() { is_cut_ = false; }
    /// Hangs up on everybody.
    void drop() {
        boost::asio::post(io_, [this] {
            for (const auto& weak : ways_)
                if (const auto way = weak.lock()) way->close();
            ways_.clear();
        });
    }

  private:
    using tcp = boost::asio::ip::tcp;
    using error_code = boost::system::error_code;
    using Clock = std::chrono::steady_clock;

    /// The two sockets of a connection.
    struct Ends {
        explicit Ends(boost::asio::io_context& io) : client(io), server(io) {}
        tcp::socket client;
        tcp::socket server;
    };

    /// One direction of a connection.
    class Way : public std::enable_shared_from_this<Way> {
      public:
        Way(LinkProxy& proxy, std::shared_ptr<Ends> ends, bool is_to_client)
            : proxy_(proxy), ends_(std::move(ends)), is_to_client_(is_to_client), timer_(proxy.io_) {}

        void read() {
            constexpr std::size_t most_waiting_bytes = 64 * 1024;
            if (is_reading_ || has_ended_ || waiting_bytes_ >= most_waiting_bytes) return;
            is_reading_ = true;
            source().async_read_some(boost::asio::buffer(arrived_),
                                     [self = shared_from_this()](error_code error, std::size_t bytes) {
                                         self->is_reading_ = false;
                                         if (error) return self->end();
                                         self->take(bytes);
                                         self->read();
                                     });
        }
        void close() {
            error_code ignored;
            ends_->client.close(ignored);
            ends_->server.close(ignored);
            timer_.cancel();
        }

      private:
        /// One end has hung up: the other learns it once it has all earlier data.
        void end() {
            has_ended_ = true;
            if (waiting_.empty()) close();
        }
        struct Piece {
            Clock::time_point due;
            std::vector<char> bytes;
        };
        tcp::socket& source() { return is_to_client_ ? ends_->server : ends_->client; }
        tcp::socket& sink() { return is_to_client_ ? ends_->client : ends_->server; }

        void take(std::size_t bytes) {
            const std::chrono::duration<double> on_the_wire(static_cast<double>(bytes) /
                                                            proxy_.quality_.bytes_per_s);
            free_at_ =
                std::max(free_at_, Clock::now()) + std::chrono::duration_cast<Clock::duration>(on_the_wire);
            std::uniform_int_distribution<std::int64_t> jitter_ms(0, proxy_.quality_.jitter.count());
            const std::chrono::milliseconds jitter(jitter_ms(proxy_.random_));
            const std::chrono::milliseconds delay(is_to_client_ ? proxy_.delay_to_client_ms_
                                                                : proxy_.delay_to_server_ms_);
            last_due_ = std::max(last_due_, free_at_ + delay + jitter);
            waiting_.push_back({last_due_, {arrived_.begin(), arrived_.begin() + static_cast<long>(bytes)}});
            waiting_bytes_ += bytes;
            if (waiting_.size() == 1) pass();
        }
        void pass() {
            timer_.expires_at(proxy_.is_cut_ ? Clock::now() + std::chrono::milliseconds(20)
                                             : waiting_.front().due);
            timer_.async_wait([self = shared_from_this()](error_code error) {
                if (error) return;
                if (self->proxy_.is_cut_) return self->pass();
                self->write();
            });
        }
        void write() {
            boost::asio::async_write(sink(), boost::asio::buffer(waiting_.front().bytes),
                                     [self = shared_from_this()](error_code error, std::size_t bytes) {
                                         if (error) return self->close();
                                         if (self->is_to_client_) self->proxy_.bytes_to_clients_ += bytes;
                                         self->waiting_bytes_ -= bytes;
                                         self->waiting_.pop_front();
                                         self->read();
                                         if (!self->waiting_.empty()) return self->pass();
                                         if (self->has_ended_) self->close();
                                     });
        }

        LinkProxy& proxy_;
        std::shared_ptr<Ends> ends_;
        bool is_to_client_;
        boost::asio::steady_timer timer_;
        std::array<char, 1460> arrived_{};  // as a packet would hold
        std::deque<Piece> waiting_;
        std::size_t waiting_bytes_ = 0;
        bool is_reading_ = false;
        bool has_ended_ = false;
        Clock::time_point free_at_{};
        Clock::time_point last_due_{};
    };

    void accept() {
        acceptor_.async_accept([this](error_code error, tcp::socket client) {
            if (error) return;
            const auto ends = std::make_shared<Ends>(io_);
            ends->client = std::move(client);
            ends->server.connect({boost::asio::ip::address_v4::loopback(), server_port_}, error);
            if (!error)
                for (const bool is_to_client : {true, false}) {
                    const auto way = std::make_shared<Way>(*this, ends, is_to_client);
                    ways_.push_back(way);
                    way->read();
                }
            accept();
        });
    }

    std::uint16_t server_port_;
    LinkQuality quality_;
    std::atomic<std::int64_t> delay_to_server_ms_{quality_.delay.count()};
    std::atomic<std::int64_t> delay_to_client_ms_{quality_.delay.count()};
    std::mt19937 random_{1};
    std::atomic<bool> is_cut_{false};
    std::atomic<std::uint64_t> bytes_to_clients_{0};
    boost::asio::io_context io_{1};
    tcp::acceptor acceptor_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
    const std::uint16_t port_ = acceptor_.local_endpoint().port();
    std::vector<std::weak_ptr<Way>> ways_;
    std::thread thread_;
};

}  // namespace osteomill::testing
