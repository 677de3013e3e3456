#include "haptic_server/streaming/streaming_server.h"

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/log/log.h"
#include "common/net/listen_address.h"
#include "common/wire/bone_replica.h"
#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"
#include "haptic_server/streaming/connected_clients.h"
#include "haptic_server/streaming/handshakes.h"
#include "haptic_server/streaming/session_recorder.h"

namespace osteomill {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

namespace {

/// How long stop() waits for clients that are slow to read the end: the time that 40 kB take at 64 kbit/s.
constexpr std::chrono::seconds longest_goodbye{5};
constexpr const char* end_of_session = "the session has ended";

/// Clients are asked for their viewpoint only if it is recorded, or the session begins with it.
SessionInfo with_view(SessionInfo session, const StreamingOptions& options) {
    session.records_view = options.record.has_value() || options.waits_for_client;
    return session;
}

/// A hello too long for a frame would fail only when a client joins.
void require_fits_frame(const v2::Hello& hello) {
    v2::ServerFrame frame;
    frame.set_sequence(~std::uint64_t{0});
    *frame.mutable_hello() = hello;
    frame.set_recorded_unix_ns(0);
    frame.set_frame_checksum(0);
    if (frame.ByteSizeLong() > largest_frame_bytes)
        throw std::invalid_argument("the scene's names take " + std::to_string(frame.ByteSizeLong()) +
                                    " bytes, more than the " + std::to_string(largest_frame_bytes) +
                                    " of a frame; shorten its burrs' and tissues' names");
}

/// The socket on which clients are awaited, bound and listening. Throws std::runtime_error, in one line, if
/// the address is none, cannot be had, or would serve other machines in the clear without being asked to.
tcp::acceptor listen(asio::io_context& io, const StreamingOptions& options) {
    const std::string where = options.address + ":" + std::to_string(options.port);
    error_code error;
    const asio::ip::address address = asio::ip::make_address(options.address, error);
    if (error)
        throw std::runtime_error("cannot listen on " + where + ": \"" + options.address +
                                 "\" is no IP address; 127.0.0.1 or ::1 would be");
    if (!address.is_loopback() && !options.tls && !options.insecure_network)
        throw std::runtime_error("cannot listen on " + where +
                                 ": without TLS only this machine is served; use 127.0.0.1 or ::1");
    if (!address.is_loopback() && !options.tls)
        log_warning("{} is served without TLS: anybody who reaches it sees everything and may drill", where);
    tcp::acceptor acceptor(io);
    const tcp::endpoint endpoint(address, options.port);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw std::runtime_error("cannot listen on " + where + ": " + error.message());
    return acceptor;
}

}  // namespace

class StreamingServer::Impl {
  public:
    Impl(StreamingOptions options, SessionInfo session, Bone mirror, StreamSource& source,
         OperatorChannel* operator_channel, std::span<const Structure> structures)
        : options_(std::move(options)),
          hello_(to_message(with_view(std::move(session), options_))),
          structures_(structure_pieces(structures)),
          mirror_(std::move(mirror)),
          source_(source),
          clients_(options_, hello_, structures_, mirror_, packers_, operator_channel,
                   [this](const SessionControl& control) { source_.control(control); }) {
        if (!(std::isfinite(options_.frame_rate_hz) && options_.frame_rate_hz > 0.0))
            throw std::invalid_argument("the frame rate is " + std::to_string(options_.frame_rate_hz) +
                                        " Hz, not above zero");
        require_sendable(mirror_.bone());
        require_fits_frame(hello_);
        period_ = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1.0 / options_.frame_rate_hz));
        frames_per_checksum_ = static_cast<std::uint64_t>(std::ceil(options_.frame_rate_hz));
    }

    ~Impl() { stop(); }

    void start() {
        if (options_.listens) acceptor_.emplace(listen(io_, options_));
        // Only now: a server that cannot listen must not have overwritten an earlier recording.
        if (options_.record) recorder_.emplace(*options_.record, hello_, mirror_, structures_);
        if (acceptor_) {
            port_ = acceptor_->local_endpoint().port();
            log_info("listening on {}{}", text_of_address(options_.address, port_),
                     options_.tls ? " with TLS" : "");
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
            recorder_->finish(state_, end_of_session);
    }

    void stop() {
        if (!thread_.joinable()) return;
        finish_recording();
        thread_.join();
    }

    bool has_client_begun() const { return has_client_begun_ || has_failed_; }
    StreamingTraffic traffic() const { return {traffic_clients_, traffic_sent_bytes_}; }
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
            clients_.end_lease();
            log_error("streaming has stopped: {}", error.what());
            clients_.cut_off("was cut off");
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
        clients_.look_after(Clock::now());
        update();
        // With a checksum each state is sent: a server whose time stands until a client begins is not silent.
        const bool waits = options_.waits_for_client && state_.tool.time_s == 0.0;
        const bool with_checksum = frames_++ % frames_per_checksum_ == 0 || waits;
        if (recorder_ && has_begun()) {
            SessionState recorded = state_;
            recorded.view = clients_.view_of_operator();
            recorder_->record(std::move(recorded), options_.paced_by_session);
        }
        clients_.show_ct([this] { return source_.ct(); });
        clients_.show(state_, with_checksum);
        has_client_begun_ = clients_.has_begun();
        traffic_clients_ = clients_.count();
        traffic_sent_bytes_ = clients_.sent_bytes();
        if (options_.listens && !is_accepting_) accept();
    }

    /// Whether there is something to record: with waits_for_client, from the first client on.
    bool has_begun() {
        if (!options_.waits_for_client || has_time_begun_) return true;
        if (!clients_.has_begun() && state_.events.empty()) return false;
        const std::chrono::duration<double> since(state_.tool.time_s);
        recorder_->session_began(std::chrono::system_clock::now() -
                                 std::chrono::duration_cast<std::chrono::nanoseconds>(since));
        has_time_begun_ = state_.tool.time_s > 0.0;
        return true;
    }

    void update() {
        state_ = source_.update(mirror_, clients_.count());
        const std::vector<BrickChange> changes = mirror_.take_changes();
        if (recorder_) recorder_->note(changes);
        clients_.note(changes);
    }

    void accept() {
        is_accepting_ = true;
        acceptor_->async_accept([this](error_code error, tcp::socket socket) {
            is_accepting_ = false;
            if (is_finishing_) return;
            if (error) {  // such as too many open files; the next frame tries again
                clients_.log_unidentified("a client could not be accepted: " + error.message());
                return;
            }
            handshakes_.begin(std::move(socket));
            accept();
        });
    }

    void finish() {
        is_finishing_ = true;
        timer_.cancel();
        if (acceptor_) acceptor_->close();
        handshakes_.cancel();
        work_.reset();
        clients_.end_lease();
        update();
        clients_.say_goodbye(state_, end_of_session, [this] { deadline_.cancel(); });
        if (clients_.count() == 0) return;
        wait_for_goodbyes(Clock::now() + longest_goodbye);
    }

    void wait_for_goodbyes(Clock::time_point until) {
        deadline_.expires_after(std::chrono::milliseconds(100));
        deadline_.async_wait([this, until](error_code error) {
            if (error) return;
            if (Clock::now() >= until)
                clients_.cut_off("was cut off: it did not read the end in time");
            else
                clients_.part_with_who_stays(Clock::now());
            if (clients_.count() > 0) wait_for_goodbyes(until);
        });
    }

    const StreamingOptions options_;
    const v2::Hello hello_;
    const std::vector<v2::StructureBricks> structures_;
    BoneReplica mirror_;
    FramePackers packers_;
    StreamSource& source_;
    SessionState state_;
    std::optional<SessionRecorder> recorder_;
    Clock::duration period_{};

    asio::io_context io_{1};
    // Without clients and a timer nothing else keeps the thread there.
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    std::optional<tcp::acceptor> acceptor_;
    ConnectedClients clients_;
    Handshakes handshakes_{
        io_,
        options_.tls.get(),
        options_.handshake_deadline,
        {.on_done = [this](std::shared_ptr<Stream> stream) { clients_.admit(std::move(stream)); },
         .on_failed =
             [this](const std::string& peer, const std::string& why) {
                 clients_.log_unidentified(fmt::format("client {} was refused: {}", peer, why));
             }},
        options_.unidentified_quota};
    asio::steady_timer timer_{io_};
    asio::steady_timer deadline_{io_};
    Clock::time_point next_frame_{};
    std::uint64_t frames_ = 0;
    std::uint64_t frames_per_checksum_ = 1;
    bool has_time_begun_ = false;  // and the recording knows when: with waits_for_client
    bool is_accepting_ = false;
    bool is_finishing_ = false;
    bool has_ended_ = false;               // the owner's
    bool has_finished_recording_ = false;  // the owner's
    std::atomic<bool> has_failed_{false};
    std::atomic<bool> has_client_begun_{false};
    std::atomic<std::size_t> traffic_clients_{0};
    std::atomic<std::uint64_t> traffic_sent_bytes_{0};
    std::uint16_t port_ = 0;
    std::thread thread_;
};

StreamingServer::StreamingServer(StreamingOptions options, SessionInfo session, Bone mirror,
                                 StreamSource& source, OperatorChannel* operator_channel,
                                 std::span<const Structure> structures)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(session), std::move(mirror), source,
                                   operator_channel, structures)) {}

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
bool StreamingServer::has_client_begun() const {
    return impl_->has_client_begun();
}
StreamingTraffic StreamingServer::traffic() const {
    return impl_->traffic();
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
