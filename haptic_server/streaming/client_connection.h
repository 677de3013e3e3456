// One client's connection: writes the frames of its OutgoingFrames, one at a time, and reads the client's
// messages.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "common/log/rate_limit.h"
#include "common/net/stream.h"
#include "common/wire/frame.h"
#include "haptic_server/streaming/client_message.h"
#include "haptic_server/streaming/outgoing_frames.h"

namespace osteomill {

/// Lives until its stream is closed. All calls and callbacks are on the thread of the stream's io_context.
class ClientConnection : public std::enable_shared_from_this<ClientConnection> {
  public:
    /// An operator's window sends a hundred a second. After a network stall of seconds they arrive at once.
    static constexpr double most_messages_per_s = 1000.0;
    static constexpr double most_messages_at_once = 2000.0;

    struct Callbacks {
        /// A message from the client; an error if it makes no sense, which drops the client.
        std::function<std::optional<WireError>(const v2::ClientFrame&)> on_message;
        /// A frame of so many bytes is on its way.
        std::function<void(std::size_t bytes)> on_sent{};
        /// Once, last: the line gives the reason of the end, and `is_fault` whether the client is to blame.
        std::function<void(const std::string& line, bool is_fault)> on_closed;
    };

    /// The stream's handshake is over.
    ClientConnection(std::shared_ptr<Stream> stream, OutgoingFrames outgoing);

    /// Reads, and writes the first frame, the hello; the rest after serve().
    void start(Callbacks callbacks);
    /// Writes all frames of the OutgoingFrames from now on.
    void serve();
    OutgoingFrames& outgoing() { return outgoing_; }
    AnsweredStates& answers() { return answers_; }
    /// Requests a state frame (OutgoingFrames::request_state) and writes it, as pump() does.
    void show(SessionState state, bool with_checksum);
    /// Writes the next frame, unless one is under way; call after the OutgoingFrames has got something new.
    void pump();
    /// How long the client's machine has had all of the end, by its acknowledgements; zero before. Called
    /// again and again.
    std::chrono::steady_clock::duration has_had_end(std::chrono::steady_clock::time_point now);
    /// Cuts the connection.
    void close(const std::string& line, bool is_fault);
    /// ADDRESS:PORT of the client, and the name in its certificate.
    const std::string& peer() const { return peer_; }
    /// Whether that certificate has been revoked since.
    bool is_revoked() const { return stream_->is_revoked(); }

  private:
    void read();
    void take(std::span<const std::uint8_t> arrived);

    std::shared_ptr<Stream> stream_;
    OutgoingFrames outgoing_;
    AnsweredStates answers_;
    Callbacks callbacks_;
    std::string peer_;
    FramePace pace_;
    bool has_said_hello_ = false;
    bool is_served_ = false;
    bool is_writing_ = false;
    bool is_closed_ = false;
    std::optional<std::chrono::steady_clock::time_point> had_end_at_;

    FrameDecoder decoder_{largest_client_frame_bytes};
    TokenBucket messages_{most_messages_per_s, most_messages_at_once};
    std::uint64_t last_sequence_ = 0;
};

}  // namespace osteomill
