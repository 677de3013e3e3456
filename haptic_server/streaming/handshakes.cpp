#include "haptic_server/streaming/handshakes.h"

#include <utility>

namespace osteomill {

using boost::system::error_code;

namespace {

/// What a client says at a time is short.
constexpr std::size_t read_bytes = 4096;

}  // namespace

Handshakes::Handshakes(boost::asio::io_context& io, TlsContext* tls, std::chrono::milliseconds deadline,
                       Callbacks callbacks)
    : io_(io), tls_(tls), deadline_(deadline), callbacks_(std::move(callbacks)) {}

void Handshakes::begin(boost::asio::ip::tcp::socket socket) {
    const auto stream = serving_stream(std::move(socket), tls_, read_bytes);
    if (under_way_.size() >= most_at_once)
        fail(under_way_.begin()->first,
             "it gave way to others, with " + std::to_string(under_way_.size()) + " handshakes under way");
    const Id id = ++last_id_;
    Handshake& handshake = under_way_.try_emplace(id, stream, io_).first->second;
    handshake.timer.expires_after(deadline_);
    handshake.timer.async_wait([this, id](error_code error) {
        if (!error) fail(id, "no TLS handshake within " + std::to_string(deadline_.count()) + " ms");
    });
    // Last: without TLS it is over before this returns.
    stream->handshake([this, id](const std::string& failure) {
        if (!failure.empty()) return fail(id, failure);
        const auto found = under_way_.find(id);
        if (found == under_way_.end()) return;
        const auto done = std::move(found->second.stream);
        under_way_.erase(found);
        callbacks_.on_done(done);
    });
}

void Handshakes::fail(Id id, const std::string& why) {
    const auto found = under_way_.find(id);
    if (found == under_way_.end()) return;
    const std::string peer = found->second.stream->peer();
    under_way_.erase(found);
    callbacks_.on_failed(peer, why);
}

}  // namespace osteomill
