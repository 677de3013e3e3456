#include "render_client/link/server_connection.h"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <utility>

#include "common/files/session_file.h"
#include "common/log/log.h"
#include "common/net/stream.h"
#include "common/text/foreign_text.h"
#include "common/wire/control_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/words/translation.h"

namespace osteomill {

namespace asio = boost::asio;
using boost::system::error_code;
using std::chrono::milliseconds;

namespace {

constexpr milliseconds first_backoff{200};
constexpr milliseconds longest_backoff{2000};

/// A server speaks 30 times a second; a cable that is pulled says nothing at all.
constexpr std::chrono::seconds longest_silence{5};

/// How often to check whether a slow disk has caught up. The server meanwhile gathers the changes that it
/// cannot send.
constexpr milliseconds recorder_check{20};

constexpr std::size_t read_bytes = 64 * 1024;

}  // namespace

ServerConnection::ServerConnection(std::string host, std::uint16_t port,
                                   const std::optional<std::filesystem::path>& record,
                                   const std::optional<TlsFiles>& tls)
    : host_(std::move(host)), port_(port), where_(host_ + ":" + std::to_string(port_)) {
    if (tls) tls_ = std::make_unique<TlsContext>(*tls, TlsContext::Role::client);
    if (record) recorder_.emplace(*record, nullptr, WhenDiskIsFull::end);
    if (record && recorder_->torn()) log_warning("{}", torn_line(*record, *recorder_->torn()));
    announce(LinkStatus::connecting, trf("connecting to {}", where_));
    asio::post(io_, [this] { connect(); });
    thread_ = std::thread([this] { run(); });
}

ServerConnection::~ServerConnection() {
    io_.stop();
    thread_.join();
}

void ServerConnection::send(const OperatorCommand& command) {
    v2::OperatorInput input = to_message(command);
    std::uint64_t connection = 0;
    {
        // The input answers the state that the operator sees now, however late it is written.
        const std::scoped_lock lock(seen_mutex_);
        if (seen_state_ == 0) return;
        input.set_answers_state(seen_state_);
        connection = seen_generation_;
    }
    asio::post(io_, [this, input = std::move(input), connection]() mutable {
        if (connection != generation_) return;
        outbox_.put(std::move(input));
        write_newest();
    });
}

void ServerConnection::send(const SessionControl& control) {
    asio::post(io_, [this, message = to_message(control)]() mutable {
        if (!receiver_.is_live()) return;
        outbox_.put(std::move(message));
        write_newest();
    });
}

void ServerConnection::send(const Viewpoint& view) {
    asio::post(io_, [this, view] {
        outbox_.put(view);
        write_newest();
    });
}

void ServerConnection::ask_for_ct() {
    asio::post(io_, [this] {
        outbox_.request_ct();
        write_newest();
    });
}

std::optional<ToolState> ServerConnection::newest_tool() const {
    const std::scoped_lock lock(seen_mutex_);
    return seen_tool_;
}

void ServerConnection::send(const v2::CompareBone& request, std::uint64_t session_number) {
    asio::post(io_, [this, request, session_number] {
        if (!receiver_.is_live() || counters_.connections != session_number) return;
        outbox_.put(request);
        write_newest();
    });
}

void ServerConnection::discard(std::shared_ptr<void> unused) {
    asio::post(io_, [unused = std::move(unused)]() mutable { unused.reset(); });
}

void ServerConnection::resume() {
    asio::post(io_, [this] {
        if (std::exchange(is_paused_, false)) read();
    });
}

std::string ServerConnection::recording_error() const {
    return recorder_ ? recorder_->report().error : std::string();
}

std::string ServerConnection::finish_recording() {
    if (!recorder_) return {};
    recorder_->commit();
    return ending_of(recorder_->report());
}

void ServerConnection::reconnect() {
    asio::post(io_, [this] {
        disconnect();
        events_.own();
        announced_ = LinkStatus::lost;
        retry_later();
    });
}

void ServerConnection::connect_to(std::string host, std::uint16_t port) {
    asio::post(io_, [this, host = std::move(host), port]() mutable {
        host_ = std::move(host);
        port_ = port;
        where_ = host_ + ":" + std::to_string(port_);
        backoff_ = milliseconds(0);
        connect();
    });
}

void ServerConnection::leave_alone(bool leaves_alone) {
    asio::post(io_, [this, leaves_alone] {
        if (std::exchange(leaves_alone_, leaves_alone) == leaves_alone || is_in_session()) return;
        if (!leaves_alone) backoff_ = milliseconds(0);
        connect();
    });
}

void ServerConnection::run() {
    while (!io_.stopped()) {
        try {
            io_.run();
        } catch (const std::exception& error) {  // such as no memory for a bone
            lose(error.what());
        }
    }
}

void ServerConnection::connect() {
    disconnect();
    if (leaves_alone_) return;
    watch_silence();
    const auto generation = generation_;
    resolver_.async_resolve(
        host_, std::to_string(port_), [this, generation](error_code error, const auto& endpoints) {
            if (generation != generation_) return;
            if (error) return lose(trf("cannot find {}: {}", host_, tr(error.message())));
            asio::async_connect(socket_, endpoints, [this, generation](error_code failure, const auto&) {
                if (generation != generation_) return;
                if (failure) return lose(trf("cannot reach {}: {}", where_, tr(failure.message())));
                error_code ignored;  // a socket without it still works
                socket_.set_option(tcp::no_delay(true), ignored);
                shake_hands();
            });
        });
}

void ServerConnection::shake_hands() {
    if (tls_) {
        const RevocationLists::Check look = tls_->refresh(std::chrono::steady_clock::now());
        if (!look.failure.empty()) log_warning("{}", look.failure);
    }
    stream_ = connecting_stream(std::move(socket_), tls_.get(), host_, read_bytes);
    stream_->handshake([this, generation = generation_](const std::string& failure) {
        if (generation != generation_) return;
        if (!failure.empty()) {
            const std::string line = trf("no TLS with {}: {}", where_, tr_filled(failure));
            return stream_->is_refused() ? refuse(line) : lose(line);
        }
        read();
    });
}

void ServerConnection::disconnect() {
    ++generation_;
    error_code ignored;
    resolver_.cancel();
    socket_.close(ignored);
    if (const auto stream = std::exchange(stream_, nullptr)) stream->close();
    has_heard_ = false;
    silence_.cancel();
    retry_.cancel();
    recorder_room_.cancel();
    decoder_ = {};
    receiver_ = SessionReceiver(gaps());
    is_paused_ = false;
    forget_seen();
    outbox_.end();
    is_writing_ = false;
}

void ServerConnection::watch_silence() {
    silence_.expires_after(longest_silence);
    silence_.async_wait([this, generation = generation_](error_code error) {
        if (!error && generation == generation_) lose(trf("{} is silent", where_));
    });
}

void ServerConnection::read() {
    if (events_.is_full()) {
        is_paused_ = true;
        silence_.cancel();
        return;
    }
    if (recorder_ && !recorder_->has_room()) return read_when_recorded();
    watch_silence();
    stream_->read([this, generation = generation_](error_code error, std::span<const std::uint8_t> arrived) {
        if (generation != generation_) return;
        // A server that does not accept this program's certificate says so in place of the first data.
        if (error && is_about_certificates(error)) return refuse(describe_loss(error));
        if (error) return lose(describe_loss(error));
        has_heard_ = true;
        counters_.bytes += arrived.size();
        counters_.heard = std::chrono::steady_clock::now().time_since_epoch();
        decoder_.append(arrived);
        take_frames();
        if (generation == generation_) read();
    });
}

void ServerConnection::read_when_recorded() {
    silence_.cancel();
    recorder_room_.expires_after(recorder_check);
    recorder_room_.async_wait([this, generation = generation_](error_code error) {
        if (!error && generation == generation_) read();
    });
}

void ServerConnection::take_frames() {
    const auto generation = generation_;
    while (const auto message = decoder_.next()) {
        if (const auto error = take(*message)) return reject(error->line);
        if (generation != generation_) return;
    }
    if (!decoder_.error().empty()) reject(decoder_.error());
}

std::optional<WireError> ServerConnection::take(std::span<const std::uint8_t> message) {
    auto frame = open_frame(message);
    if (auto* error = std::get_if<WireError>(&frame)) return std::move(*error);
    auto event = receiver_.take(std::get<v2::ServerFrame>(std::move(frame)));
    if (auto* error = std::get_if<WireError>(&event)) return std::move(*error);
    if (recorder_) {
        const Stamp now = std::chrono::system_clock::now();
        recorder_->push(now, with_recorded_time(message, now.time_since_epoch().count()));
    }
    std::visit([this](auto&& what) { take_event(std::forward<decltype(what)>(what)); },
               std::get<SessionEvent>(std::move(event)));
    return std::nullopt;
}

void ServerConnection::take_event(SnapshotGoesOn) {
    counters_.snapshot_bricks = receiver_.bricks_received();
    counters_.snapshot_bricks_total = receiver_.bricks_announced();
}

void ServerConnection::take_event(SessionInfo session) {
    outbox_.begin(session);
    write_newest();
    ++counters_.connections;
    counters_.snapshot_bricks = 0;
    counters_.snapshot_bricks_total = 0;
    events_.push(SessionBegan{std::move(session), counters_.connections});
    announce(LinkStatus::receiving_snapshot, trf("receiving the bone from {}", where_));
}

void ServerConnection::take_event(BoneArrived arrived) {
    events_.push(std::move(arrived));
    announce(LinkStatus::live, trf("connected to {}", where_));
    backoff_ = milliseconds(0);
}

void ServerConnection::take_event(StateArrived arrived) {
    see(arrived);
    events_.push(std::move(arrived));
}

void ServerConnection::see(const StateArrived& arrived) {
    const std::scoped_lock lock(seen_mutex_);
    seen_generation_ = generation_;
    seen_state_ = receiver_.last_sequence();
    seen_tool_ = arrived.state.tool;
}

void ServerConnection::forget_seen() {
    const std::scoped_lock lock(seen_mutex_);
    seen_state_ = 0;
    seen_tool_.reset();
}

void ServerConnection::take_event(const SaidGoodbye& goodbye) {
    disconnect();
    announce(LinkStatus::finished, where_ + ": " + tr_filled(one_line(goodbye.reason)));
    retry_later();
}

void ServerConnection::take_event(const SpeaksOtherProtocol& other) {
    refuse(trf("{} speaks protocol {} (Osteomill {}), this program {}: update the older of the two", where_,
               other.major, other.program_version, protocol_major));
}

void ServerConnection::write_newest() {
    if (is_writing_) return;
    const auto frame = outbox_.next();
    if (!frame) return;
    std::string bytes;
    append_frame(*frame, bytes);
    is_writing_ = true;
    stream_->write(std::move(bytes), [this, generation = generation_](error_code error) {
        if (generation != generation_) return;
        is_writing_ = false;
        if (!error) write_newest();  // an error shows in reading, too
    });
}

void ServerConnection::reject(const std::string& line) {
    ++counters_.rejected_frames;
    announced_ = LinkStatus::lost;  // not to be passed over in silence, whatever came before
    lose(trf("{} makes no sense: {}", where_, line));
}

void ServerConnection::lose(const std::string& line) {
    disconnect();
    // After a goodbye or a refusal, a server that does not answer is no news.
    if (announced_ != LinkStatus::finished && announced_ != LinkStatus::refused)
        announce(counters_.connections > 0 ? LinkStatus::lost : LinkStatus::connecting,
                 trf("{}; trying again", line));
    retry_later();
}

void ServerConnection::refuse(std::string line) {
    disconnect();
    announce(LinkStatus::refused, std::move(line));
    backoff_ = longest_backoff;
    retry_later();
}

std::string ServerConnection::describe_loss(error_code error) const {
    if (has_heard_ || (error != asio::error::eof && !is_refusal(error)))
        return trf("lost {}: {}", where_, tr_filled(describe_stream_error(error)));
    if (tls_) return trf("{} turned this client away: {}", where_, tr_filled(describe_stream_error(error)));
    return trf("{} hung up at once: it is full, or wants certificates (TLS) from this program", where_);
}

void ServerConnection::retry_later() {
    backoff_ = std::clamp(2 * backoff_, first_backoff, longest_backoff);
    retry_.expires_after(backoff_);
    retry_.async_wait([this, generation = generation_](error_code error) {
        if (!error && generation == generation_) connect();
    });
}

void ServerConnection::announce(LinkStatus status, std::string line) {
    announced_ = status;
    events_.push(StatusChanged{status, std::move(line)});
}

}  // namespace osteomill
