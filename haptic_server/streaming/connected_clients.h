// All clients connected to a streaming server: their identity, their rights, and their frames.
//
// A connection is unidentified until its hello, and is served from then on. One client may move the tool, see
// ToolLease. All calls are on the thread of the connections' io_context.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/bone/brick_change.h"
#include "common/log/rate_limit.h"
#include "common/session/session_state.h"
#include "common/wire/bone_replica.h"
#include "common/wire/frame.h"
#include "haptic_server/streaming/client_connection.h"
#include "haptic_server/streaming/connection_quota.h"
#include "haptic_server/streaming/leases.h"
#include "haptic_server/streaming/streaming_options.h"

namespace osteomill {

class ConnectedClients {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `hello`: the first frame of each client; `structures`: the messages of the protected structures.
    /// `operator_channel`: null if no client can move the tool. `control`: takes requests for the session
    /// from clients with that right, if the hello accepts them. All references outlive this.
    ConnectedClients(const StreamingOptions& options, const v2::Hello& hello,
                     const std::vector<v2::StructureBricks>& structures, const BoneReplica& mirror,
                     FramePackers& packers, OperatorChannel* operator_channel,
                     std::function<void(const SessionControl&)> control);

    /// One whose handshake is over.
    void admit(std::shared_ptr<Stream> stream);

    /// Once a frame, before it is made: ends expired leases, and drops clients with revoked certificates and
    /// connections without a hello.
    void look_after(Time now);
    /// To be called for every change of the mirror.
    void note(std::span<const BrickChange> changes);
    /// Sends the CT to the clients that requested it. `ct` is called only if there are any, and may have none
    /// yet.
    void show_ct(const std::function<std::shared_ptr<const CtVolume>()>& ct);
    /// Sends everybody a state frame.
    void show(const SessionState& state, bool with_checksum);

    /// Nobody moves the tool any more.
    void end_lease();
    /// Sends all clients the last state and a goodbye. Calls `when_gone` as soon as none is left.
    void say_goodbye(const SessionState& state, const std::string& reason, std::function<void()> when_gone);
    /// Afterwards: closes connections whose machine has had all data for a second, even if they do not hang
    /// up.
    void part_with_who_stays(Time now);
    void cut_off(const std::string& line);

    /// Log of unidentified connections; a few lines at a time.
    void log_unidentified(const std::string& line);

    /// The viewpoint of the operator: the client that moves the tool, did so last or, if none did, used the
    /// controls. If nobody steers the session, the viewpoint of the first client. Nothing if that client does
    /// not state it.
    std::optional<Viewpoint> view_of_operator();

    std::size_t count() const { return connections_.size(); }
    /// One that may operate has stated its viewpoint, which a window does once the bone is drawn, or has
    /// moved the tool or used the controls.
    bool has_begun() const { return has_begun_; }
    /// Frames sent, to all present and former clients.
    std::uint64_t sent_bytes() const { return sent_bytes_; }

  private:
    using Id = ToolLease::ClientId;

    /// Identified clients.
    std::size_t clients() const { return connections_.size() - unidentified_.size(); }
    bool may_control(Id id, Time now) const;
    v2::Hello hello_for(bool may_operate) const;
    SessionState state_for(Id id, const SessionState& state, Time now) const;
    std::optional<WireError> take(Id id, const v2::ClientFrame& frame);
    void dismiss(Id id, const std::string& peer, const std::string& line, bool is_fault);
    void drop_revoked(Time now);
    void log_client(const std::string& line);
    void log_holder();

    const StreamingOptions& options_;
    const v2::Hello& hello_;
    const std::vector<v2::StructureBricks>& structures_;
    const BoneReplica& mirror_;
    FramePackers& packers_;
    std::optional<ToolLease> tool_lease_;
    ControlLease control_lease_;  // where there is no tool lease
    std::function<void(const SessionControl&)> control_;
    LeaseHistory lease_history_;
    std::map<Id, std::optional<Viewpoint>> views_;  // only clients that stated one
    std::optional<Id> steered_last_;                // set while that client is connected

    std::map<Id, std::shared_ptr<ClientConnection>> connections_;
    /// The connections from which no hello has come. They are sent a hello and nothing else, so that an
    /// untrusted peer costs no snapshot.
    ConnectionQuota unidentified_;
    std::set<Id> watchers_;       // connections that may not move the tool
    std::set<Id> refused_input_;  // those of them that the log has named for sending input
    Id last_client_ = 0;
    std::uint64_t sent_bytes_ = 0;
    bool has_begun_ = false;
    std::function<void()> when_gone_;  // also called once goodbye has been sent

    // Each with its share of the log.
    LimitedLog unidentified_log_;
    LimitedLog client_log_;
};

}  // namespace osteomill
