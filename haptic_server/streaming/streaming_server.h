// Server that shows the bone and the tool to every client: a snapshot, then state frames at 30 Hz.
//
// One thread of its own. It keeps its own copy of the bone (the mirror), so it never touches the milling
// loop's, and applies the changes at every frame, watched or not. Memory is bounded: for each client one
// frame under way and a set of voxels to be sent. A slow client gets fewer frames and misses nothing; a
// client that sends invalid data is dropped with one log line. No client is served before its hello, and a
// connection without one cannot take a client's place: see ConnectionQuota. With TLS a client needs a
// certificate of the lab's CA; without it, only this machine is served unless an option says otherwise.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "common/recording/recording_writer.h"
#include "common/wire/session_info.h"
#include "haptic_server/streaming/stream_source.h"
#include "haptic_server/streaming/streaming_options.h"
#include "simulation/exchange/operator_channel.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// Between a server and its clients, as of the last frame.
struct StreamingTraffic {
    std::size_t clients = 0;       ///< that are connected
    std::uint64_t sent_bytes = 0;  ///< in frames, to all clients since the start
};

class StreamingServer {
  public:
    /// `mirror` equals the bone of `source` before its first update(). The server is the one writer of
    /// `operator_channel`, which is null unless the device is driven by a client; both outlive it.
    /// `structures`: the protected ones, so far as clients cannot tell from the bone where they are. Throws
    /// std::invalid_argument for a frame rate that is not above zero, a bone or structures too large to send,
    /// or a scene whose names do not fit a frame.
    StreamingServer(StreamingOptions options, SessionInfo session, Bone mirror, StreamSource& source,
                    OperatorChannel* operator_channel = nullptr, std::span<const Structure> structures = {});
    /// Stops first, if need be.
    ~StreamingServer();
    StreamingServer(const StreamingServer&) = delete;
    StreamingServer& operator=(const StreamingServer&) = delete;

    /// Binds the port, begins the recording and starts to serve. Throws std::runtime_error, in one line, if
    /// the address cannot be had or nothing can be recorded.
    void start();

    /// Sends a frame of the shown session, and returns when that is done: with paced_by_session.
    void show_frame();

    // The end, in three steps, so that saving a bone waits for neither clients nor a disk.
    // Each takes those before it first, and does nothing the second time.

    /// Call after the milling loop has ended: takes over the last changes, and begins to send every client
    /// the final state with its checksum and a goodbye.
    void end();
    /// Waits until the recording is written, or cannot be.
    void finish_recording();
    /// Waits up to about 5 s for clients that are slow to read the end, closes, joins.
    void stop();

    /// Any thread: a client that may operate has the bone drawn, or moves the tool or controls the session;
    /// or streaming has failed, and none will come. With waits_for_client every client is asked for its
    /// viewpoint, recorded or not, which a window sends when the bone is there.
    bool has_client_begun() const;
    /// Any thread.
    StreamingTraffic traffic() const;
    /// The port that is listened on, after start().
    std::uint16_t port() const;
    /// Checksum of the mirror, after end().
    std::uint64_t mirror_checksum() const;
    /// The outcome of the recording, after finish_recording(); nothing if none was requested.
    std::optional<RecordingReport> recording() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
