// Messages of a client that wait to be sent to a server: the controls in order, of every other kind the
// newest. One thread at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/session/viewpoint.h"
#include "common/wire/frame.h"
#include "common/wire/session_info.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

class ClientOutbox {
  public:
    static constexpr std::size_t most_waiting_controls = 64;

    /// A session has begun on a connection: the hello goes first, and the session decides which other
    /// messages are accepted.
    void begin(const SessionInfo& session);
    /// The connection is gone: nothing waits, and nothing is accepted. The viewpoint is kept for the next
    /// one.
    void end();

    // Each is dropped if the session does not accept it.
    void put(v2::OperatorInput input);
    /// Dropped, too, beyond most_waiting_controls.
    void put(v2::SessionControl control);
    void put(const v2::CompareBone& request) { request_ = request; }
    /// Sent only if it differs from the last one.
    void put(const Viewpoint& view);
    void request_ct() { owes_ct_request_ = has_ct_; }

    /// Takes out the next message, numbered; nothing if none waits.
    std::optional<v2::ClientFrame> next();

  private:
    // The inputs that the session accepts.
    bool accepts_operator_ = false;
    bool accepts_controls_ = false;
    bool has_ct_ = false;
    bool records_view_ = false;
    std::size_t burr_count_ = 0;

    bool owes_hello_ = false;
    bool owes_ct_request_ = false;
    bool owes_view_ = false;
    std::optional<Viewpoint> view_;
    std::optional<v2::OperatorInput> input_;
    std::optional<v2::CompareBone> request_;
    std::deque<v2::SessionControl> controls_;
    std::uint64_t input_number_ = 0;    // within the connection
    std::uint64_t frame_sequence_ = 0;  // within the connection
};

}  // namespace osteomill
