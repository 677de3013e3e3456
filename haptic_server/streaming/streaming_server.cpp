#include "haptic_server/streaming/streaming_server.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>

#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "haptic_server/streaming/bone_mirror.h"
#include "haptic_server/streaming/changes_of_hands.h"
#include "haptic_server/streaming/client_connection.h"
#include "haptic_server/streaming/client_feed.h"
#include "haptic_server/streaming/client_message.h"
#include "haptic_server/streaming/control_lease.h"
#include "haptic_server/streaming/fair_places.h"
#include "haptic_server/streaming/handshakes.h"
#include "haptic_server/streaming/limited_log.h"
#include "haptic_server/streaming/listener.h"
#include "haptic_server/streaming/session_recorder.h"
#include "haptic_server/streaming/unidentified_connections.h"

namespace osteomill {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

namespace {

/// Bounds what strangers can make the server hold; a class of students looks on through far fewer.
constexpr std::size_t most_clients = 32;

/// How long stop() waits for clients that are slow to read the end: for 40 kB at 64 kbit/s.
constexpr std::chrono::seconds longest_goodbye{5};
constexpr const char* end_of_session = "the session has ended";

/// A hello too long for a frame would fail only when a client joins.
void require_fits_frame(const v1::Hello& hello) {
    v1::ServerFrame frame;
    frame.set_sequence(~std::uint64_t{0});
    *frame.mutable_hello() = hello;
    frame.set_recorded_unix_ns(0);
    frame.set_frame_checksum(0);
    if (frame.ByteSizeLong() > largest_frame_bytes)
        throw std::invalid_argument("the scene's names take " + std::to_string(frame.ByteSizeLong()) +
                                    " bytes, more than the " + std::to_string(largest_frame_bytes) +
                                    " of a frame; shorten its burrs' and tissues' names");
}

std::int64_t unix_time_ns() {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

}  // namespace

class StreamingServer::Impl {
  public:
    Impl(StreamingOptions options, SessionInfo session, Bone mirror, StreamSource& source,
         TripleBuffer<OperatorInput>* operator_input)
        : options_(std::move(options)),
          hello_(to_message(session)),
          burr_count_(session.burrs.size()),
          mirror_(std::move(mirror)),
          source_(source) {
        if (!(std::isfinite(options_.frame_rate_hz) && options_.frame_rate_hz > 0.0))
            throw std::invalid_argument("the frame rate is " + std::to_string(options_.frame_rate_hz) +
                                        " Hz, not above zero");
        require_sendable(mirror_.bone());
        require_fits_frame(hello_);
        if (operator_input != nullptr) lease_.emplace(*operator_input);
        period_ = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1.0 / options_.frame_rate_hz));
        frames_per_checksum_ = static_cast<std::uint64_t>(std::ceil(options_.frame_rate_hz));
    }

    ~Impl() { stop(); }

    void start() {
        if (options_.listens) acceptor_.emplace(listen(io_, options_));
        // Only now: a server that cannot listen must not have overwritten an earlier recording.
        if (options_.record)
            recorder_.emplace(options_.record->file, options_.record->began, hello_, mirror_, packer_);
        if (acceptor_) {
            port_ = acceptor_->local_endpoint().port();
            spdlog::info("listening on {}:{}{}", options_.address, port_, options_.tls ? " with TLS" : "");
            accept();
        }
        next_frame_ = Clock::now();
        if (!options_.paced_by_session) wait_for_next_frame();
        thread_ = std::thread([this] { run(); });
    }

    void show_frame() {
        run_there([this] {
            if (!is_finishing_) send_frame();
        });
    }

    void end() {
        if (!thread_.joinable() || std::exchange(has_ended_, true)) return;
        run_there([this] { finish(); });
    }

    void finish_recording() {
        end();
        if (recorder_ && !std::exchange(has_finished_recording_, true))
            recorder_->finish(last_view_, end_of_session);
    }

    void stop() {
        if (!thread_.joinable()) return;
        finish_recording();
        thread_.join();
    }

    std::uint16_t port() const { return port_; }
    std::uint64_t mirror_checksum() const { return mirror_.checksum(); }
    std::optional<RecordingReport> recording() const {
        return recorder_ ? std::optional(recorder_->report()) : std::nullopt;
    }

  private:
    /// Does it on the streaming thread and waits until it is done, unless that thread has failed.
    template <typename Work>
    void run_there(Work work) {
        const auto done = std::make_shared<std::promise<void>>();
        asio::post(io_, [work, done] {
            work();
            done->set_value();
        });
        const auto is_done = done->get_future();
        while (is_done.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready &&
               !has_failed_) {
        }
    }

    void run() {
        try {
            io_.run();
        } catch (const std::exception& error) {
            // Haptics go on without spectators.
            has_failed_ = true;
            if (lease_) lease_->end();
            spdlog::error("streaming has stopped: {}", error.what());
            for (const auto& [id, connection] : std::map(connections_))
                connection->close("was cut off", false);
            handshakes_.cancel();
        }
    }

    void wait_for_next_frame() {
        // After a pause of the machine, go on from now rather than catch up on frames that nobody needs.
        next_frame_ = std::max(next_frame_ + period_, Clock::now());
        timer_.expires_at(next_frame_);
        timer_.async_wait([this](error_code error) {
            if (error || is_finishing_) return;
            send_frame();
            wait_for_next_frame();
        });
    }

    void send_frame() {
        if (lease_) lease_->check_silence(Clock::now());
        log_holder();
        drop_revoked();
        for (const ControlLease::ClientId id : unidentified_.take_patient(Clock::now()))
            connections_.at(id)->serve();
        update();
        const bool with_checksum = frames_++ % frames_per_checksum_ == 0;
        if (recorder_) recorder_->record(last_view_, with_checksum, options_.paced_by_session);
        // A recording's packets have stamps of their own.
        const std::int64_t now_unix_ns = unix_time_ns();
        for (const auto& [id, connection] : std::map(connections_)) {  // one may close and leave the map
            ToolView stamped = view_for(id);
            stamped.taken_unix_ns = now_unix_ns;
            connection->show(stamped, with_checksum);
        }
        if (options_.listens && !is_accepting_) accept();
        client_log_.tell_left_out(Clock::now());
        unidentified_log_.tell_left_out(Clock::now());
    }

    ToolView view_for(ControlLease::ClientId id) const {
        ToolView view = last_view_;
        if (lease_) view.driver = watchers_.contains(id) ? ToolDriver::others_only : lease_->driver_for(id);
        return view;
    }

    /// What one is greeted with who may or may not move the tool.
    v1::Hello hello_for(bool may_operate) const {
        v1::Hello hello = hello_;
        hello.set_accepts_operator(hello.accepts_operator() && may_operate);
        return hello;
    }

    /// After the lease knows: nobody waits for a log.
    void log_holder() {
        if (!lease_) return;
        const auto peer_of = [this](auto id) { return connections_.at(id)->peer(); };
        for (const auto& line : changes_of_hands_.look(lease_->holder(), peer_of)) log_client(line);
    }

    /// Those who are in when their certificates are revoked are out.
    void drop_revoked() {
        if (!options_.tls) return;
        const RevocationLists::Look look = options_.tls->refresh(Clock::now());
        if (!look.failure.empty()) spdlog::warn("{}", look.failure);
        if (!look.has_news) return;
        for (const auto& [id, connection] : std::map(connections_))
            if (connection->is_revoked()) connection->close("was dropped: its certificate is revoked", true);
    }

    void update() {
        last_view_ = source_.update(mirror_, connections_.size());
        const std::vector<BrickChange> changes = mirror_.take_changes();
        if (recorder_) recorder_->note(changes);
        for (const auto& [id, connection] : connections_) connection->feed().note(changes);
    }

    void accept() {
        is_accepting_ = true;
        acceptor_->async_accept([this](error_code error, tcp::socket socket) {
            is_accepting_ = false;
            if (is_finishing_) return;
            if (error) {  // such as too many open files; the next frame tries again
                log_unidentified("a client could not be accepted: " + error.message());
                return;
            }
            handshakes_.begin(std::move(socket));
            accept();
        });
    }

    void log_client(const std::string& line) { client_log_.write(spdlog::level::info, line, Clock::now()); }

    void log_unidentified(const std::string& line) {
        unidentified_log_.write(spdlog::level::warn, line, Clock::now());
    }

    /// Those who have said who they are, by certificate or greeting.
    std::size_t clients() const { return connections_.size() - unidentified_.size(); }

    void admit(std::shared_ptr<Stream> stream) {
        if (clients() >= most_clients) {
            log_unidentified(fmt::format("client {} was turned away: {} are connected already",
                                         stream->peer(), clients()));
            return stream->close();
        }
        const ControlLease::ClientId id = ++last_client_;
        const bool may_operate = !options_.operators || options_.operators->names(stream->subject());
        if (!may_operate) watchers_.insert(id);
        error_code ignored;  // one who has gone already leaves as soon as it is read
        const Origin origin = origin_of(stream->socket().remote_endpoint(ignored).address());
        const auto connection = std::make_shared<ClientConnection>(
            std::move(stream), ClientFeed(hello_for(may_operate), mirror_, packer_));
        connections_.emplace(id, connection);
        if (options_.tls) {
            welcome(*connection);
        } else {
            if (const auto oldest = unidentified_.in_the_way())
                connections_.at(*oldest)->close("gave way to others: it had not said a word", false);
            unidentified_.add(id, origin, Clock::now());
        }
        connection->start({.on_message = [this, id](const v1::ClientFrame& frame) { return take(id, frame); },
                           .on_closed = [this, id, peer = connection->peer()](
                                            const std::string& line,
                                            bool is_fault) { dismiss(id, peer, line, is_fault); }});
        if (options_.tls) connection->serve();
    }

    void welcome(const ClientConnection& connection) {
        log_client(fmt::format("client {} joined", connection.peer()));
    }

    void dismiss(ControlLease::ClientId id, const std::string& peer, const std::string& line, bool is_fault) {
        // First of all: a hand that has gone must not keep the burr turning.
        if (lease_) lease_->leave(id);
        const bool was_unidentified = unidentified_.remove(id);
        (was_unidentified ? unidentified_log_ : client_log_)
            .write(is_fault ? spdlog::level::warn : spdlog::level::info,
                   fmt::format("client {} {}", peer, line), Clock::now());
        connections_.erase(id);
        watchers_.erase(id);
        refused_input_.erase(id);
        log_holder();
        if (is_finishing_ && connections_.empty()) deadline_.cancel();
    }

    std::optional<WireError> take(ControlLease::ClientId id, const v1::ClientFrame& frame) {
        const std::shared_ptr<ClientConnection> connection = connections_.at(id);
        if (unidentified_.remove(id)) {
            if (clients() > most_clients)
                return WireError{fmt::format("{} clients are connected already", most_clients)};
            welcome(*connection);
            connection->serve();
        }
        auto taken = take_client_message(
            frame,
            {.id = id,
             .feed = connection->feed(),
             .answers = connection->answers(),
             .packer = change_packer_,
             .lease = lease_ && !is_finishing_ && !watchers_.contains(id) ? &*lease_ : nullptr,
             .burr_count = burr_count_},
            Clock::now());
        log_holder();
        if (frame.has_operator_input() && watchers_.contains(id) && refused_input_.insert(id).second)
            log_client(fmt::format("client {} may only watch; what it asks of the tool is refused",
                                   connection->peer()));
        if (auto* error = std::get_if<WireError>(&taken)) return std::move(*error);
        connection->pump();
        const auto& answer = std::get<std::optional<Answer>>(taken);
        if (const std::string reason = answer ? reason_to_ignore(*answer) : ""; !reason.empty())
            client_log_.write(spdlog::level::warn, fmt::format("client {} {}", connection->peer(), reason),
                              Clock::now());
        return std::nullopt;
    }

    void finish() {
        is_finishing_ = true;
        timer_.cancel();
        if (acceptor_) acceptor_->close();
        handshakes_.cancel();
        work_.reset();
        if (lease_) lease_->end();
        log_holder();
        update();
        for (const auto& [id, connection] : std::map(connections_)) {
            connection->feed().request_state(view_for(id), true);
            connection->feed().finish(end_of_session);
            connection->serve();
        }
        if (connections_.empty()) return;
        deadline_.expires_after(longest_goodbye);
        deadline_.async_wait([this](error_code error) {
            if (error) return;
            for (const auto& [id, connection] : std::map(connections_))
                connection->close("was cut off: it did not read the end in time", false);
        });
    }

    const StreamingOptions options_;
    const v1::Hello hello_;
    const std::size_t burr_count_;
    BoneMirror mirror_;
    SnapshotPacker packer_;
    ChangePacker change_packer_;
    StreamSource& source_;
    ToolView last_view_;
    std::optional<SessionRecorder> recorder_;
    std::optional<ControlLease> lease_;
    Clock::duration period_{};

    asio::io_context io_{1};
    // Without clients and a timer nothing else keeps the thread there.
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    std::optional<tcp::acceptor> acceptor_;
    // Each with its share of the log.
    LimitedLog unidentified_log_;
    LimitedLog client_log_;
    Handshakes handshakes_{io_,
                           options_.tls.get(),
                           options_.handshake_deadline,
                           {.on_done = [this](std::shared_ptr<Stream> stream) { admit(std::move(stream)); },
                            .on_failed =
                                [this](const std::string& peer, const std::string& why) {
                                    log_unidentified(fmt::format("client {} was refused: {}", peer, why));
                                }},
                           options_.places_for_unidentified};
    asio::steady_timer timer_{io_};
    asio::steady_timer deadline_{io_};
    std::map<ControlLease::ClientId, std::shared_ptr<ClientConnection>> connections_;
    UnidentifiedConnections unidentified_{
        options_.places_for_unidentified};            // those of the connections who are that
    std::set<ControlLease::ClientId> watchers_;       // those of the connections who may not move the tool
    std::set<ControlLease::ClientId> refused_input_;  // and of these, who have been named in the log for it
    ChangesOfHands changes_of_hands_;
    ControlLease::ClientId last_client_ = 0;
    Clock::time_point next_frame_{};
    std::uint64_t frames_ = 0;
    std::uint64_t frames_per_checksum_ = 1;
    bool is_accepting_ = false;
    bool is_finishing_ = false;
    bool has_ended_ = false;               // the owner's
    bool has_finished_recording_ = false;  // the owner's
    std::atomic<bool> has_failed_{false};
    std::uint16_t port_ = 0;
    std::thread thread_;
};

StreamingServer::StreamingServer(StreamingOptions options, SessionInfo session, Bone mirror,
                                 StreamSource& source, TripleBuffer<OperatorInput>* operator_input)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(session), std::move(mirror), source,
                                   operator_input)) {}

StreamingServer::~StreamingServer() = default;
void StreamingServer::start() {
    impl_->start();
}
void StreamingServer::show_frame() {
    impl_->show_frame();
}
void StreamingServer::end() {
    impl_->end();
}
void StreamingServer::finish_recording() {
    impl_->finish_recording();
}
void StreamingServer::stop() {
    impl_->stop();
}
std::uint16_t StreamingServer::port() const {
    return impl_->port();
}
std::uint64_t StreamingServer::mirror_checksum() const {
    return impl_->mirror_checksum();
}
std::optional<RecordingReport> StreamingServer::recording() const {
    return impl_->recording();
}

}  // namespace osteomill
