// Sources of sessions: a server (BoneLink), a recording of one, or a script in its place.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/net/listen_address.h"
#include "render_client/link/bone_link.h"
#include "render_client/link/recording_player.h"

namespace osteomill {

/// What a BoneLink does; see there. All calls on one thread but for those marked; none of them waits.
class SessionSource {
  public:
    virtual ~SessionSource() = default;
    virtual LinkUpdate poll() = 0;
    virtual const Bone* bone() const = 0;                            ///< null until one has arrived
    virtual const SessionInfo* session() const = 0;                  ///< null until a server has said hello
    virtual void send_operator(const OperatorCommand& command) = 0;  ///< any thread
    /// Asks for the CT, which a poll then brings; nothing where there is none.
    virtual void ask_for_ct() {}
    /// To a server elsewhere from now on; nothing where there is none.
    virtual void connect_to(const ListenAddress&) {}
    /// Any thread: a request to the session; ignored if there is none to take it.
    virtual void send_control(const SessionControl&) {}
    /// From where the operator looks; nothing where nobody keeps it.
    virtual void send_view(const Viewpoint&) {}
    /// Any thread: of the session that an operator may be at; nothing where there is none.
    virtual std::optional<ToolState> newest_tool() const { return std::nullopt; }
    /// What plays the session, where it is a recording; null where it is not.
    virtual RecordingPlayer* player() { return nullptr; }
    /// Once, after the last poll: a failure of the run that did not end it, in one line; mostly nothing.
    virtual std::string finish() { return {}; }
};

/// A server's session.
class LinkedSession final : public SessionSource {
  public:
    LinkedSession(std::string host, std::uint16_t port, const std::optional<std::filesystem::path>& record,
                  const std::optional<TlsFiles>& tls)
        : link_(std::move(host), port, record, tls) {}
    LinkUpdate poll() override { return link_.poll(); }
    const Bone* bone() const override { return link_.bone(); }
    const SessionInfo* session() const override { return link_.session(); }
    void send_operator(const OperatorCommand& command) override { link_.send_operator(command); }
    void ask_for_ct() override { link_.ask_for_ct(); }
    void connect_to(const ListenAddress& server) override { link_.connect_to(server.address, server.port); }
    void send_control(const SessionControl& control) override { link_.send_control(control); }
    void send_view(const Viewpoint& view) override { link_.send_view(view); }
    std::optional<ToolState> newest_tool() const override { return link_.newest_tool(); }
    std::string finish() override { return link_.finish_recording(); }

  private:
    BoneLink link_;
};

/// A recorded session. Nobody can drive it.
class ReplayedSession final : public SessionSource {
  public:
    /// Begins at `from_s`. Throws RecordingError.
    ReplayedSession(std::filesystem::path file, double speed, double from_s = 0.0)
        : player_(std::move(file), speed) {
        if (from_s > player_.duration_s())
            throw RecordingError(
                fmt::format("--from-s {}: the recording lasts {:.3f} s", from_s, player_.duration_s()));
        player_.seek(from_s);
    }
    LinkUpdate poll() override { return player_.poll(std::chrono::steady_clock::now()); }
    const Bone* bone() const override { return player_.bone(); }
    const SessionInfo* session() const override { return player_.session(); }
    void send_operator(const OperatorCommand&) override {}
    RecordingPlayer* player() override { return &player_; }
    std::string finish() override { return player_.error(); }

  private:
    RecordingPlayer player_;
};

}  // namespace osteomill
