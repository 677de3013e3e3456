// Handling of the messages that a client sends. No sockets, no clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "common/session/viewpoint.h"
#include "common/wire/frame.h"
#include "haptic_server/streaming/leases.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// Age of the information on which a client's operator acts: each input names the newest state frame that its
/// client had received, and this class remembers when the content of that frame was last current. So both
/// directions of the link are measured by the server's clock alone: a delayed input and an outdated picture
/// are treated alike, and neither may move the tool.
///
///     age of an answer = now - when the state that it answers was last true
///
/// A state is current from the making of its frame until there is something newer to send: a tool at rest is
/// sent only ten times a second. No sockets, no clock.
class AnsweredStates {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Input that answers an older state moves nothing. The limit allows for a round trip of 200 ms and the
    /// time between two state frames; a person on such a link still sees the present situation.
    static constexpr std::chrono::milliseconds longest_age{250};

    enum class Answer {
        fresh,
        stale,     ///< too old
        repeated,  ///< not numbered higher than all before: repeated, or overtaken
        unnamed,   ///< it names no state, as one that has seen none yet
        unsent,    ///< it names a state that was not sent: no honest client does that
    };

    /// A state frame of this number (they ascend) has been made.
    void sent(std::uint64_t number, Time now);
    /// Nothing has changed since the state sent last.
    void still_true(Time now);

    /// An input of this number (from 1; they ascend) that names that state (0: none).
    Answer judge(std::uint64_t input_number, std::uint64_t state_number, Time now);
    /// Whether the last input was judged differently from those before; at first they count as fresh.
    /// Repeated ones do not count.
    bool is_news() const { return is_news_; }

  private:
    Answer judge_new(std::uint64_t state_number, Time now) const;

    struct State {
        std::uint64_t number = 0;
        Time true_until;
    };
    /// Older states are dropped, and count as too old: OutgoingFrames makes that many in a tenth of a
    /// second at most.
    static constexpr std::size_t most_kept = 1024;

    std::deque<State> states_;  // ascending; those that are too old go, but for the last
    std::uint64_t last_input_ = 0;
    Answer last_answer_ = Answer::fresh;
    bool is_news_ = false;
};

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
