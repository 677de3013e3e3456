#include "haptic_server/streaming/connected_clients.h"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <utility>
#include <variant>

#include "common/log/log.h"
#include "common/net/tls_context.h"
#include "haptic_server/streaming/client_message.h"
#include "haptic_server/streaming/connection_quota.h"

namespace osteomill {

namespace {

/// Bounds the memory that untrusted peers can make the server hold; a class of students needs far fewer.
constexpr std::size_t most_clients = 32;

/// A client says hello within two round trips; this allows for a busy machine.
constexpr std::chrono::seconds patience{10};

std::int64_t unix_time_ns() {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

}  // namespace

ConnectedClients::ConnectedClients(const StreamingOptions& options, const v2::Hello& hello,
                                   const std::vector<v2::StructureBricks>& structures,
                                   const BoneReplica& mirror, FramePackers& packers,
                                   OperatorChannel* operator_channel,
                                   std::function<void(const SessionControl&)> control)
    : options_(options),
      hello_(hello),
      structures_(structures),
      mirror_(mirror),
      packers_(packers),
      control_(std::move(control)),
      unidentified_(options.unidentified_quota) {
    if (operator_channel != nullptr) tool_lease_.emplace(*operator_channel);
}

void ConnectedClients::admit(std::shared_ptr<Stream> stream) {
    if (clients() >= most_clients) {
        log_unidentified(
            fmt::format("client {} was turned away: {} are connected already", stream->peer(), clients()));
        return stream->close();
    }
    const Id id = ++last_client_;
    const bool may_operate = !options_.operators || options_.operators->names(stream->subject());
    if (!may_operate) watchers_.insert(id);
    boost::system::error_code ignored;  // one who has gone already leaves as soon as it is read
    const Origin origin = origin_of(stream->socket().remote_endpoint(ignored).address());
    const auto connection = std::make_shared<ClientConnection>(
        std::move(stream), OutgoingFrames(hello_for(may_operate), mirror_, packers_, structures_));
    connections_.emplace(id, connection);
    if (const auto oldest = unidentified_.next_to_go())
        connections_.at(*oldest)->close("gave way to others: it had not said hello", false);
    unidentified_.add(id, origin, std::chrono::steady_clock::now());
    connection->start(
        {.on_message = [this, id](const v2::ClientFrame& frame) { return take(id, frame); },
         .on_sent = [this](std::size_t bytes) { sent_bytes_ += bytes; },
         .on_closed = [this, id, peer = connection->peer()](
                          const std::string& line, bool is_fault) { dismiss(id, peer, line, is_fault); }});
}

void ConnectedClients::look_after(Time now) {
    if (tool_lease_) tool_lease_->check_silence(now);
    log_holder();
    drop_revoked(now);
    for (const Id id : unidentified_.here_since(now - patience))
        connections_.at(id)->close("was dropped: it did not say hello", false);
    client_log_.tell_left_out(now);
    unidentified_log_.tell_left_out(now);
}

void ConnectedClients::note(std::span<const BrickChange> changes) {
    for (const auto& [id, connection] : connections_) connection->outgoing().note(changes);
}

void ConnectedClients::show_ct(const std::function<std::shared_ptr<const CtVolume>()>& ct) {
    for (const auto& [id, connection] : connections_) {
        if (!hello_.has_ct() || !connection->outgoing().wants_ct()) continue;
        if (auto volume = ct()) connection->outgoing().give_ct(std::move(volume));
    }
}

std::optional<Viewpoint> ConnectedClients::view_of_operator() {
    if (const auto steers = tool_lease_ ? tool_lease_->holder() : control_lease_.holder())
        steered_last_ = steers;
    const auto looks = steered_last_ ? views_.find(*steered_last_) : views_.begin();
    return looks != views_.end() ? looks->second : std::nullopt;
}

void ConnectedClients::show(const SessionState& state, bool with_checksum) {
    const Time now = std::chrono::steady_clock::now();
    // A recording's packets have stamps of their own.
    const std::int64_t now_unix_ns = unix_time_ns();
    for (const auto& [id, connection] : std::map(connections_)) {  // one may close and leave the map
        SessionState stamped = state_for(id, state, now);
        stamped.tool.taken_unix_ns = now_unix_ns;
        connection->show(std::move(stamped), with_checksum);
    }
}

void ConnectedClients::end_lease() {
    if (tool_lease_) tool_lease_->end();
    log_holder();
}

void ConnectedClients::say_goodbye(const SessionState& state, const std::string& reason,
                                   std::function<void()> when_gone) {
    when_gone_ = std::move(when_gone);
    const Time now = std::chrono::steady_clock::now();
    for (const auto& [id, connection] : std::map(connections_)) {
        if (unidentified_.contains(id)) {
            connection->close("had not said hello when the session ended", false);
            continue;
        }
        connection->outgoing().request_state(state_for(id, state, now), true);
        connection->outgoing().finish(reason);
        connection->pump();
    }
}

void ConnectedClients::part_with_who_stays(Time now) {
    for (const auto& [id, connection] : std::map(connections_))
        if (connection->has_had_end(now) >= std::chrono::seconds(1))
            connection->close("has had the end, and was parted with", false);
}

void ConnectedClients::cut_off(const std::string& line) {
    for (const auto& [id, connection] : std::map(connections_)) connection->close(line, false);
}

void ConnectedClients::log_unidentified(const std::string& line) {
    unidentified_log_.write(LogLevel::warning, line, std::chrono::steady_clock::now());
}

bool ConnectedClients::may_control(Id id, Time now) const {
    if (!hello_.accepts_controls() || when_gone_ || watchers_.contains(id)) return false;
    if (!tool_lease_) return control_lease_.is_open_to(id, now);
    return !tool_lease_->holder() || *tool_lease_->holder() == id;
}

v2::Hello ConnectedClients::hello_for(bool may_operate) const {
    v2::Hello hello = hello_;
    hello.set_accepts_controls(hello.accepts_controls() && may_operate);
    hello.set_records_view(hello.records_view() && may_operate);
    hello.set_accepts_operator(hello.accepts_operator() && may_operate);
    return hello;
}

SessionState ConnectedClients::state_for(Id id, const SessionState& state, Time now) const {
    SessionState theirs = state;
    theirs.view.reset();
    theirs.status.may_control = may_control(id, now);
    if (tool_lease_)
        theirs.tool.driver = watchers_.contains(id) ? ToolDriver::others_only : tool_lease_->driver_for(id);
    return theirs;
}

std::optional<WireError> ConnectedClients::take(Id id, const v2::ClientFrame& frame) {
    const std::shared_ptr<ClientConnection> connection = connections_.at(id);
    if (unidentified_.contains(id)) {
        if (auto error = check_greeting(frame)) return error;
        unidentified_.remove(id);
        if (clients() > most_clients)
            return WireError{fmt::format("{} clients are connected already", most_clients)};
        log_client(fmt::format("client {} joined", connection->peer()));
        connection->serve();
        return std::nullopt;
    }
    const Time now = std::chrono::steady_clock::now();
    const bool controls = frame.has_session_control() && may_control(id, now);
    if (controls) control_lease_.use(id, now);
    const bool may_operate = tool_lease_ && !when_gone_ && !watchers_.contains(id);
    const bool shows_view = frame.has_viewpoint() && hello_.records_view() && !watchers_.contains(id);
    auto taken = take_client_message(frame,
                                     {.id = id,
                                      .outgoing = connection->outgoing(),
                                      .answers = connection->answers(),
                                      .lease = may_operate ? &*tool_lease_ : nullptr,
                                      .burr_count = static_cast<std::size_t>(hello_.burrs_size()),
                                      .control = controls ? &control_ : nullptr,
                                      .view = shows_view ? &views_[id] : nullptr},
                                     now);
    has_begun_ = has_begun_ || controls || shows_view || (may_operate && frame.has_operator_input());
    log_holder();
    if (frame.has_operator_input() && watchers_.contains(id) && refused_input_.insert(id).second)
        log_client(
            fmt::format("client {} may only watch; what it asks of the tool is refused", connection->peer()));
    if (auto* error = std::get_if<WireError>(&taken)) return std::move(*error);
    connection->pump();
    const auto& answer = std::get<std::optional<Answer>>(taken);
    if (const std::string reason = answer ? reason_to_ignore(*answer) : ""; !reason.empty())
        client_log_.write(LogLevel::warning, fmt::format("client {} {}", connection->peer(), reason),
                          std::chrono::steady_clock::now());
    return std::nullopt;
}

void ConnectedClients::dismiss(Id id, const std::string& peer, const std::string& line, bool is_fault) {
    // First of all: a hand that has gone must not keep the burr turning.
    if (tool_lease_) tool_lease_->leave(id);
    control_lease_.leave(id);
    views_.erase(id);
    if (steered_last_ == id) steered_last_.reset();
    const bool was_unidentified = unidentified_.remove(id);
    (was_unidentified ? unidentified_log_ : client_log_)
        .write(is_fault ? LogLevel::warning : LogLevel::info, fmt::format("client {} {}", peer, line),
               std::chrono::steady_clock::now());
    connections_.erase(id);
    watchers_.erase(id);
    refused_input_.erase(id);
    log_holder();
    if (when_gone_ && connections_.empty()) when_gone_();
}

void ConnectedClients::drop_revoked(Time now) {
    if (!options_.tls) return;
    const RevocationLists::Check look = options_.tls->refresh(now);
    if (!look.failure.empty()) log_warning("{}", look.failure);
    if (!look.has_news) return;
    for (const auto& [id, connection] : std::map(connections_))
        if (connection->is_revoked()) connection->close("was dropped: its certificate is revoked", true);
}

void ConnectedClients::log_client(const std::string& line) {
    client_log_.write(LogLevel::info, line, std::chrono::steady_clock::now());
}

void ConnectedClients::log_holder() {
    // After the lease knows: nobody waits for a log.
    if (!tool_lease_) return;
    const auto peer_of = [this](auto id) { return connections_.at(id)->peer(); };
    for (const auto& line : lease_history_.update(tool_lease_->holder(), peer_of)) log_client(line);
}

}  // namespace osteomill
