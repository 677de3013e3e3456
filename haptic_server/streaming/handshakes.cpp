#include "haptic_server/streaming/handshakes.h"

#include <utility>

namespace osteomill {

using boost::asio::ip::tcp;
using boost::system::error_code;

namespace {

/// A client's messages during a handshake are short.
constexpr std::size_t read_bytes = 4096;

}  // namespace

Handshakes::Handshakes(boost::asio::io_context& io, TlsContext* tls, std::chrono::milliseconds deadline,
                       Callbacks callbacks, std::size_t most_at_once)
    : io_(io), tls_(tls), deadline_(deadline), callbacks_(std::move(callbacks)), quota_(most_at_once) {}

void Handshakes::begin(tcp::socket socket) {
    if (tls_ == nullptr) {
        const auto stream = serving_stream(std::move(socket), nullptr, read_bytes);
        return stream->handshake([&](const std::string&) { callbacks_.on_done(stream); });
    }
    error_code error;
    const tcp::endpoint from = socket.remote_endpoint(error);
    if (error) return;  // gone again
    if (const auto oldest = quota_.next_to_go())
        fail(*oldest,
             "it gave way to others, with " + std::to_string(quota_.size()) + " handshakes under way");
    const Id id = ++last_id_;
    Handshake& handshake = under_way_.try_emplace(id, std::move(socket), io_).first->second;
    quota_.add(id, origin_of(from.address()), std::chrono::steady_clock::now());
    handshake.timer.expires_after(deadline_);
    handshake.timer.async_wait([this, id](error_code failure) {
        if (!failure) fail(id, "no TLS handshake within " + std::to_string(deadline_.count()) + " ms");
    });
    handshake.socket.async_wait(tcp::socket::wait_read, [this, id](error_code failure) {
        if (!failure) shake_hands(id);
    });
}

void Handshakes::shake_hands(Id id) {
    const auto begun = under_way_.find(id);
    if (begun == under_way_.end()) return;
    error_code error;
    if (begun->second.socket.available(error) == 0) return fail(id, "it hung up");
    const auto stream = serving_stream(std::move(begun->second.socket), tls_, read_bytes);
    begun->second.stream = stream;
    stream->handshake([this, id](const std::string& failure) {
        if (!failure.empty()) return fail(id, failure);
        const auto found = under_way_.find(id);
        if (found == under_way_.end()) return;
        const auto done = std::exchange(found->second.stream, nullptr);
        under_way_.erase(found);
        quota_.remove(id);
        callbacks_.on_done(done);
    });
}

void Handshakes::fail(Id id, const std::string& why) {
    const auto found = under_way_.find(id);
    if (found == under_way_.end()) return;
    const Handshake& handshake = found->second;
    const std::string peer = handshake.stream ? handshake.stream->peer() : describe_end(handshake.socket);
    under_way_.erase(found);
    quota_.remove(id);
    callbacks_.on_failed(peer, why);
}

void Handshakes::cancel() {
    under_way_.clear();
    quota_.clear();
}

}  // namespace osteomill
