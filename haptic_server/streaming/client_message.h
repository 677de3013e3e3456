// What a server does with what a client sends. No sockets, no clock.
#pragma once

#include <optional>

#include "common/wire/wire_error.h"
#include "haptic_server/streaming/client_feed.h"
#include "haptic_server/streaming/operator_seat.h"
#include "osteomill/v1/session.pb.h"

namespace osteomill {

/// A client, as far as its messages reach.
struct MessagingClient {
    OperatorSeat::ClientId id = 0;
    ClientFeed& feed;              ///< may have something to say afterwards
    EditGuesser& guesser;          ///< of all clients that take guessed edits; outlives the feed
    OperatorSeat* seat = nullptr;  ///< null: nobody may move the tool now, and input changes nothing
    std::size_t burr_count = 0;    ///< of the session
};

/// A client is told of edits as guesses if it takes them and is of protocol 1.4 or later.
/// An error if the message makes no sense, which drops the client: no body, numbers that are not finite, a
/// burr that is not there, a comparison that ClientFeed refuses. It has then changed nothing.
std::optional<WireError> take_client_message(const v1::ClientFrame& frame, const MessagingClient& client,
                                             OperatorSeat::Time now);

}  // namespace osteomill
