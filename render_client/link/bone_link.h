// The connection to the haptic server: keeps a copy of the bone equal to the server's.
//
// A thread of its own receives frames; poll() applies them, so the bone changes only inside poll(). Losing
// the server is a status, never an exception: the link tries again after 0.2 s, then ever less often up to 2
// s. Every checksum that the server states is checked. A mismatch or a gap in the sequence is counted, shown,
// and answered by asking for the bricks that differ: see BoneRepair. Where that fails, the server is older
// than protocol 1.2, or a frame makes no sense, the link connects afresh, which brings a fresh snapshot.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/bone/ct_volume.h"
#include "common/net/tls_files.h"
#include "common/scene/operator_command.h"
#include "common/scene/session_control.h"
#include "common/scene/structure.h"
#include "common/scene/structure_distance.h"
#include "common/scene/tool_state.h"
#include "common/scene/viewpoint.h"
#include "common/wire/session_info.h"
#include "render_client/link/delay_meter.h"

namespace osteomill {

enum class LinkStatus {
    connecting,          ///< has not reached a server yet
    receiving_snapshot,  ///< connected; bone() is still the one before, if any
    live,                ///< bone() follows the server's
    lost,                ///< the connection broke; trying again
    finished,            ///< the server said goodbye; bone() is what it left; trying again quietly
    /// The server speaks another major version of the protocol, or one of the two does not accept the
    /// other's certificate: trying again, but somebody has to do something.
    refused,
};

/// What happened since the last poll, and where the link stands.
struct LinkUpdate {
    LinkStatus status = LinkStatus::connecting;
    std::string status_line{};             ///< for people
    bool bone_replaced = false;            ///< bone() is another bone: upload all of it
    std::vector<BrickChange> changes;      ///< of bone(), ascending; empty if bone_replaced
    std::optional<ToolState> tool;         ///< the newest since the last poll, if any came
    std::vector<Structure> structures{};   ///< that came since the last poll, or with bone()
    std::shared_ptr<const CtVolume> ct{};  ///< that was requested, once it is here
    std::vector<ControlEvent> events{};    ///< since the last poll
    /// Of protected structures that are near the burr or were touched, as of the newest tool.
    std::vector<StructureDistance> distances{};
    /// From where the one who moves the tool looks, in a recording that says so.
    std::optional<Viewpoint> view{};
    SessionStatus controls{};  ///< what can be done with the session now
    /// How old the newest tool of this session was when a poll took it; nothing where the server does not
    /// say.
    std::optional<DelayMeter::Delay> delay{};

    std::uint32_t snapshot_bricks = 0;        ///< received so far, while receiving_snapshot
    std::uint32_t snapshot_bricks_total = 0;  ///< announced, while receiving_snapshot

    /// Why nothing more is recorded; empty while all is well, and where nothing is to be.
    std::string recording_error{};

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

class BoneLink {
  public:
    /// Starts to connect; returns at once, also if there is no such server. What is received goes into
    /// `record`, too, if that is given: a disk that is slow makes the server gather what it has to tell. One
    /// that fails ends the recording there: what comes later makes no sense without what is missing, and to
    /// ask for that anew would stop the view for the recording's sake. (The server's own recording goes on.)
    /// Throws RecordingError where it cannot begin.
    BoneLink(std::string host, std::uint16_t port,
             const std::optional<std::filesystem::path>& record = std::nullopt,
             const std::optional<TlsFiles>& tls = std::nullopt);
    ~BoneLink();
    BoneLink(const BoneLink&) = delete;
    BoneLink& operator=(const BoneLink&) = delete;

    /// UI thread, once a frame. Applies what has come, up to about one second's worth of state frames.
    LinkUpdate poll();

    /// UI thread. Null until the first snapshot is complete; valid until the next poll(). A lost server
    /// leaves the last bone.
    const Bone* bone() const;
    /// UI thread. Null until a server has said hello.
    const SessionInfo* session() const;

    /// Any thread. Sends what the operator wants, as an answer to newest_tool(); dropped before that is
    /// known, while not connected, and where it makes no sense. While an earlier one is still under way only
    /// the newest is kept. Call it 50 times a second while the operator is at the controls, from the thread
    /// that reads them: the server takes 0.2 s of silence for an operator who has gone, and lifts the pedal.
    void send_operator(const OperatorCommand& command);

    /// Any thread. Asks something of the session, in order; dropped while not connected, and where the server
    /// does not take it. What comes of it is an event.
    void send_control(const SessionControl& control);

    /// Any thread. The operator's viewpoint, at most thirty times a second; sent where it has changed, to a
    /// server that records it.
    void send_view(const Viewpoint& view);

    /// UI thread. To another server from now on: the one before is left, and its bone stays until the next
    /// has come.
    void connect_to(std::string host, std::uint16_t port);

    /// UI thread. Asks for the CT of the session, if the server has one.
    void ask_for_ct();

    /// Any thread. The newest that has come of the tool, be it applied by poll() or not; nothing while not
    /// connected.
    std::optional<ToolState> newest_tool() const;

    /// UI thread. Ends the recording and waits until it is written; one line where some of it is not, else
    /// nothing.
    std::string finish_recording();

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
