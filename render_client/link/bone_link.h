// The connection to the haptic server: keeps a copy of the bone equal to the server's.
//
// A thread of its own receives frames; poll() applies them, so the bone changes only inside poll(). Losing
// the server is a status, never an exception: the link tries again after 0.2 s, then ever less often up to 2
// s. Every checksum that the server states is checked. A mismatch or a gap in the sequence is counted, shown,
// and answered by asking for the bricks that differ: see BoneRepair (verified_replica.h). If that fails, if
// the server is older than protocol 1.2, or if a frame makes no sense, the link connects afresh, which brings
// a fresh snapshot.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/net/tls_options.h"
#include "render_client/link/session_source.h"

namespace osteomill {

class BoneLink final : public SessionSource {
  public:
    /// Starts to connect; returns at once, also if there is no such server. If `record` is given, received
    /// frames are recorded there, too. A slow disk makes the server gather its changes. A disk that fails
    /// ends the recording: later frames make no sense without the missing ones, and to request those again
    /// would stop the view for the recording's sake. (The server's own recording goes on.) Throws
    /// RecordingError if the recording cannot begin.
    BoneLink(std::string host, std::uint16_t port,
             const std::optional<std::filesystem::path>& record = std::nullopt,
             const std::optional<TlsFiles>& tls = std::nullopt);
    ~BoneLink() override;
    BoneLink(const BoneLink&) = delete;
    BoneLink& operator=(const BoneLink&) = delete;

    /// Applies received frames, up to about one second's worth of state frames.
    LinkUpdate poll() override;
    /// A lost server leaves the last bone.
    const Bone* bone() const override;
    const SessionInfo* session() const override;
    /// Sends a command that answers newest_tool(); drops it before that state is known, while not connected,
    /// and if it makes no sense. While an earlier one is still under way, only the newest is kept. Call it 50
    /// times a second while the operator is at the controls, from the thread that reads them: after 0.2 s of
    /// silence the server assumes that the operator has gone, and lifts the pedal.
    void send_operator(const OperatorCommand& command) override;
    /// Sends controls in order; drops them while not connected, and if the server does not accept them. The
    /// outcome arrives as an event.
    void send_control(const SessionControl& control) override;
    /// At most thirty times a second; sent if it has changed, to a server that records it.
    void send_view(const Viewpoint& view) override;
    /// The server before is left, and its bone stays until the next has come.
    void connect_to(const ListenAddress& server) override;
    void leave_alone(bool leaves_alone) override;
    void ask_for_ct() override;
    /// The newest received state, even if poll() has not applied it yet; nothing while not connected.
    std::optional<ToolState> newest_tool() const override;
    /// Ends the recording and waits until it is written; one line where some of it is not.
    std::string finish() override;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
