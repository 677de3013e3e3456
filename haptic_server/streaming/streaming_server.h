// Shows the bone and the tool to every client that connects: a snapshot, then state frames at 30 Hz.
//
// One thread of its own. It keeps its own copy of the bone (the mirror), so it never touches the milling
// loop's, and takes edits from the queue at every frame whether or not anybody watches. Memory is bounded:
// for each client there is one frame under way and a set of voxels that it has yet to be told of. A slow
// client gets fewer frames and misses nothing; one that sends nonsense is dropped with one log line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "haptic_server/exchange/operator_input.h"
#include "haptic_server/exchange/triple_buffer.h"
#include "haptic_server/loop/edit_queue.h"
#include "haptic_server/loop/exchange.h"

namespace osteomill {

struct StreamingOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 7010;  ///< 0 lets the system choose; see StreamingServer::port
    double frame_rate_hz = 30.0;
};

class StreamingServer {
  public:
    /// `mirror` equals the milling loop's bone before the first edit. The server is the one consumer of
    /// `edits`, the one reader of `tool`, and the one writer of `operator_input`, which is null unless the
    /// device is driven by a client; all three outlive it. Throws std::invalid_argument for a frame rate that
    /// is not above zero, a bone too large to send, or a scene whose names do not fit a frame.
    StreamingServer(StreamingOptions options, const Scene& scene, Bone mirror,
                    TripleBuffer<ToolSnapshot>& tool, EditQueue& edits,
                    TripleBuffer<OperatorInput>* operator_input, double force_limit_n,
                    std::string program_version);
    /// Stops first, if need be.
    ~StreamingServer();
    StreamingServer(const StreamingServer&) = delete;
    StreamingServer& operator=(const StreamingServer&) = delete;

    /// Binds and begins to serve. Throws std::runtime_error, in one line, if the address cannot be had.
    void start();

    /// Call after the milling loop has ended: takes over the last edits, sends every client the final state
    /// with its checksum and a goodbye, waits up to about 2 s for slow ones, closes, joins. A second call
    /// does nothing.
    void stop();

    /// The port that is listened on, after start().
    std::uint16_t port() const;
    /// Checksum of the mirror, after stop().
    std::uint64_t mirror_checksum() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
