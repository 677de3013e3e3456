// Handling of the messages that a client sends. No sockets, no clock.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "common/session/viewpoint.h"
#include "common/wire/frame.h"
#include "haptic_server/streaming/answered_states.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "haptic_server/streaming/tool_lease.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// A client, as far as its messages reach.
struct MessagingClient {
    ToolLease::ClientId id = 0;
    OutgoingFrames& outgoing;    ///< may have more to send afterwards
    AnsweredStates& answers;     ///< for the states that the client has been sent
    ToolLease* lease = nullptr;  ///< null: nobody may move the tool now, and input changes nothing
    std::size_t burr_count = 0;  ///< the session's burrs
    /// Takes the client's requests for the session; null: none are accepted now.
    const std::function<void(const SessionControl&)>* control = nullptr;
    std::optional<Viewpoint>* view = nullptr;  ///< the client's viewpoint; null: it is not wanted
};

/// Outcome of an operator's input, accepted or not; see AnsweredStates.
using Answer = AnsweredStates::Answer;

/// The first message of a client must be a hello of this major version; the error names the message that came
/// instead.
std::optional<WireError> check_greeting(const v2::ClientFrame& frame);

/// Any later message. An operator's input is given to the lease if it is fresh. A control of the session is
/// passed on; a client without the right to it gets a refusal. An invalid message returns an error, which
/// drops the client, and changes nothing: no body, numbers that are not finite, a viewpoint that
/// viewpoint_from refuses, a burr that does not exist, an answer to a state that was not sent, a comparison
/// that OutgoingFrames refuses. Otherwise returns the outcome of an operator's input if it is new: different
/// from the one before, or the first that is not fresh.
std::variant<std::optional<Answer>, WireError> take_client_message(const v2::ClientFrame& frame,
                                                                   const MessagingClient& client,
                                                                   ToolLease::Time now);

/// The reason why such input moves nothing, to follow the client's name in a log; empty if it does, and for
/// repeated input, which does no harm.
std::string reason_to_ignore(Answer answer);

}  // namespace osteomill
