// The part of a session that streams it to clients, records it, and lets them control it.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/files/output_place.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/save_and_finish.h"
#include "haptic_server/session/session_scene.h"
#include "haptic_server/streaming/live_session.h"
#include "haptic_server/streaming/streaming_server.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

struct ShownOptions {
    StreamingOptions streaming{};            ///< to whom, where, and the recording
    ControlScript script{};                  ///< requests that come at given times without anybody
    const OutputPlace* save_bone = nullptr;  ///< where a client may have the bone saved; outlives the session
    std::string words_at_finish{};           ///< the answer to the client that ends the session
    bool accepts_controls = true;            ///< from clients
    // The session as clients and recordings see it.
    std::string version{};
    std::string trainee{};
    std::string case_name{};
    std::map<std::string, std::string> settings{};
    std::string scene_toml{};
};

class ShownSession {
  public:
    /// Listens and begins to record. `scene`, whose structures it takes, `session` and `device` outlive it;
    /// `mirror` equals the session's bone. Throws as StreamingServer does.
    ShownSession(ShownOptions options, SessionScene& scene, Bone mirror, MillingSession& session,
                 const DeviceParts& device);

    StreamingServer& server() { return server_; }
    bool finish_requested() const { return keeper_.finish_requested(); }
    /// With waits_for_client: returns when a client has begun, one ends the session, or `stop` is set. Before
    /// the session runs.
    void wait_for_client(const std::atomic<bool>& stop) const;
    /// Reports a failure to save to the log and to clients.
    void tell(const std::string& line) { keeper_.tell(line); }

    /// Begins to say goodbye, and waits for a bone that is being saved. Call once the session has ended.
    void end();
    // After end().
    /// Outcomes for the protected structures.
    const StructureWatch& structures() const { return live_.structures(); }
    /// The last place of the tool chosen by a client, if any.
    const std::optional<ToolPose>& placed() const { return placed_; }

  private:
    ControlRunner::Requests requests(const ShownOptions& options, const Scene& scene,
                                     const DeviceParts& device, FixtureSet held);

    const bool waits_for_client_;
    SaveAndFinish keeper_;
    std::optional<ToolPose> placed_;  // the streaming thread's until end()
    ControlRunner controls_;
    LiveSession live_;
    StreamingServer server_;
};

}  // namespace osteomill
