#include "haptic_server/monitoring/metrics_server.h"

#include <fmt/format.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "common/log/log.h"
#include "common/text/foreign_text.h"
#include "haptic_server/monitoring/host_name.h"

namespace osteomill {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::chrono::seconds longest_visit{2};
constexpr std::size_t most_visits = 16;
constexpr std::chrono::milliseconds pause_after_error{100};
constexpr std::size_t longest_request_bytes = 8192;
constexpr const char* path = "/metrics";

tcp::acceptor listening(asio::io_context& io, const ListenAddress& where) {
    try {
        return {io, tcp::endpoint(asio::ip::make_address(where.address), where.port)};
    } catch (const boost::system::system_error& error) {
        throw std::runtime_error(fmt::format("--metrics {}: {}", to_text(where), error.code().message()));
    }
}

/// One that asks, from the connection to the answer. Lives as long as something of it is under way.
class Visit : public std::enable_shared_from_this<Visit> {
  public:
    Visit(tcp::socket socket, const std::function<std::string()>& text, const std::vector<std::string>& names)
        : stream_(std::move(socket)), text_(text), names_(names) {}

    void begin() {
        stream_.expires_after(longest_visit);
        http::async_read(stream_, buffer_, request_,
                         [self = shared_from_this()](error_code error, std::size_t) {
                             if (!error) self->answer();
                         });
    }
    void break_off() { stream_.cancel(); }

  private:
    void answer() {
        answer_.version(request_.version());
        answer_.keep_alive(false);
        answer_.set(http::field::content_type, "text/plain; version=0.0.4; charset=utf-8");
        const std::string_view target(request_.target().data(), request_.target().size());
        if (const std::optional<std::string> refused = refused_host()) {
            answer_.result(http::status::misdirected_request);
            answer_.body() = fmt::format(
                "this page is not of '{}': ask for it by localhost or by an address, or start "
                "haptic_server with --metrics-host NAME\n",
                printable(*refused));
        } else if (target.substr(0, target.find('?')) != path) {
            answer_.result(http::status::not_found);
            answer_.body() = fmt::format("there is {} alone\n", path);
        } else if (request_.method() != http::verb::get) {
            answer_.result(http::status::method_not_allowed);
            answer_.set(http::field::allow, "GET");
        } else {
            answer_.body() = text_();
        }
        answer_.prepare_payload();
        http::async_write(stream_, answer_, [self = shared_from_this()](error_code, std::size_t) {
            error_code ignored;
            self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
        });
    }

    /// The name that it was asked for by, if that is not its own.
    std::optional<std::string> refused_host() const {
        const auto [first, last] = request_.equal_range(http::field::host);
        for (auto field = first; field != last; ++field) {
            const std::string host(field->value().data(), field->value().size());
            if (!is_own_host(host, names_)) return host;
        }
        return std::nullopt;
    }

    beast::tcp_stream stream_;
    const std::function<std::string()>& text_;
    const std::vector<std::string>& names_;
    beast::flat_buffer buffer_{longest_request_bytes};
    http::request<http::empty_body> request_;
    http::response<http::string_body> answer_;
};

}  // namespace

class MetricsServer::Impl {
  public:
    Impl(const ListenAddress& where, std::function<std::string()> text, std::vector<std::string> names)
        : text_(std::move(text)), names_(std::move(names)), acceptor_(listening(io_, where)) {
        accept();
        thread_ = std::thread([this] { run(); });
    }
    ~Impl() {
        io_.stop();
        thread_.join();
    }

    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  private:
    void run() {
        try {
            io_.run();
        } catch (const std::exception& error) {
            log_error("--metrics has stopped: {}", error.what());
        }
    }

    void accept() {
        acceptor_.async_accept([this](error_code error, tcp::socket socket) {
            if (error) return pause();
            const auto visit = std::make_shared<Visit>(std::move(socket), text_, names_);
            visit->begin();
            // A visitor that sends half a request and waits keeps nobody out.
            if (const auto oldest = std::exchange(visits_[next_], visit).lock()) oldest->break_off();
            next_ = (next_ + 1) % visits_.size();
            accept();
        });
    }

    /// Such as after too many open files.
    void pause() {
        timer_.expires_after(pause_after_error);
        timer_.async_wait([this](error_code) { accept(); });
    }

    std::function<std::string()> text_;
    std::vector<std::string> names_;
    asio::io_context io_{1};  // data under way in it go before its requests
    tcp::acceptor acceptor_;
    asio::steady_timer timer_{io_};
    std::array<std::weak_ptr<Visit>, most_visits> visits_{};
    std::size_t next_ = 0;
    std::thread thread_;
};

MetricsServer::MetricsServer(const ListenAddress& where, std::function<std::string()> text,
                             std::vector<std::string> names)
    : impl_(std::make_unique<Impl>(where, std::move(text), std::move(names))) {}
MetricsServer::~MetricsServer() = default;
std::uint16_t MetricsServer::port() const {
    return impl_->port();
}

}  // namespace osteomill
