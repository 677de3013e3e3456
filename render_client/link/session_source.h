// Source of a session, which a client asks in every frame for news (render_client/ui/view/session_picture.cpp
// polls it): a server (BoneLink), a recording of one (RecordingPlayer), or a script in its place.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/bone/ct_volume.h"
#include "common/bone/structure_mask.h"
#include "common/net/listen_address.h"
#include "common/session/operator_command.h"
#include "common/session/session_control.h"
#include "common/session/structure_distance.h"
#include "common/session/tool_state.h"
#include "common/session/viewpoint.h"
#include "common/wire/session_info.h"
#include "render_client/link/link_meters.h"

namespace osteomill {

class RecordingPlayer;

enum class LinkStatus {
    connecting,          ///< has not reached a server yet
    receiving_snapshot,  ///< connected; bone() is still the one before, if any
    live,                ///< bone() follows the server's
    lost,                ///< the connection broke; trying again
    finished,            ///< the server said goodbye; bone() is the last bone; trying again quietly
    /// The server speaks another major version of the protocol, or one of the two does not accept the
    /// other's certificate: trying again, but somebody has to do something.
    refused,
};

/// The news since the last poll, and the link's status.
struct LinkUpdate {
    LinkStatus status = LinkStatus::connecting;
    std::string status_line{};             ///< for people
    bool bone_replaced = false;            ///< bone() is another bone: upload all of it
    std::vector<BrickChange> changes;      ///< changes of bone(), ascending; empty if bone_replaced
    std::optional<ToolState> tool;         ///< the newest since the last poll, if any came
    std::vector<Structure> structures{};   ///< those that came since the last poll, or with bone()
    std::shared_ptr<const CtVolume> ct{};  ///< that was requested, once it is here
    std::vector<ControlEvent> events{};    ///< since the last poll
    /// The distances of protected structures that are near the burr or were touched, as of the newest tool.
    std::vector<StructureDistance> distances{};
    /// The viewpoint of the person who moves the tool, if the recording states it.
    std::optional<Viewpoint> view{};
    SessionStatus controls{};  ///< the controls that the session accepts now
    /// How old the newest tool of this session was when a poll took it; nothing if the server does not
    /// say.
    std::optional<DelayMeter::Delay> delay{};

    std::uint32_t snapshot_bricks = 0;        ///< received so far, while receiving_snapshot
    std::uint32_t snapshot_bricks_total = 0;  ///< announced, while receiving_snapshot

    /// Why nothing more is recorded; empty while all is well, and if nothing is to be.
    std::string recording_error{};

    /// The time since anything came from the server; 0 for a recording.
    double silent_s = 0.0;

    // Since the link was made.
    std::uint64_t frames = 0;               ///< state frames applied
    std::uint64_t checksums_verified = 0;   ///< stated by the server and found equal
    std::uint64_t checksum_mismatches = 0;  ///< stated by the server and found different
    std::uint64_t rejected_frames = 0;      ///< gaps in the sequence, frames that made no sense
    std::uint64_t connections = 0;          ///< sessions joined
    std::uint64_t repairs = 0;              ///< after which bone() was equal again
    std::uint64_t bricks_repaired = 0;      ///< that differed

    // Over about the last second.
    double frames_per_s = 0.0;
    double bytes_per_s = 0.0;
};

/// All calls on one thread but for those marked; none of them waits, but for the last.
class SessionSource {
  public:
    virtual ~SessionSource() = default;
    /// Once a frame: reads new messages. The bone changes only here.
    virtual LinkUpdate poll() = 0;
    /// Null until one has arrived; valid until the next poll().
    virtual const Bone* bone() const = 0;
    virtual const SessionInfo* session() const = 0;  ///< null until a server has said hello
    /// Any thread. Sends the operator's wishes for the tool; ignored if nobody can drive it.
    virtual void send_operator(const OperatorCommand&) {}
    /// Asks for the CT, which a poll then brings; nothing if there is none.
    virtual void ask_for_ct() {}
    /// To a server elsewhere from now on; nothing if there is none.
    virtual void connect_to(const ListenAddress&) {}
    /// Whether sessions that begin are left alone, until told otherwise; one that was joined goes on.
    virtual void leave_alone(bool) {}
    /// Any thread: a request to the session; ignored if there is none to take it.
    virtual void send_control(const SessionControl&) {}
    /// Any thread: sends the operator's viewpoint; ignored if the session does not keep it.
    virtual void send_view(const Viewpoint&) {}
    /// Any thread. The tool of the session that an operator may be at; nothing if there is none.
    virtual std::optional<ToolState> newest_tool() const { return std::nullopt; }
    /// The player of the session, if it is a recording; else null.
    virtual RecordingPlayer* player() { return nullptr; }
    /// Once, after the last poll: a failure of the run that did not end it, in one line; mostly nothing.
    virtual std::string finish() { return {}; }
};

}  // namespace osteomill
