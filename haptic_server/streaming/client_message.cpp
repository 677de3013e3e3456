#include "haptic_server/streaming/client_message.h"

#include <variant>

#include "common/wire/protocol_version.h"
#include "common/wire/scene_messages.h"

namespace osteomill {

std::optional<WireError> take_client_message(const v1::ClientFrame& frame, const MessagingClient& client,
                                             OperatorSeat::Time now) {
    if (frame.has_hello()) {
        if (frame.hello().takes_guessed_edits() &&
            frame.hello().protocol_minor() >= first_minor_that_smooths_guesses)
            client.feed.guess_edits(client.guesser);
        return std::nullopt;
    }
    if (frame.has_compare_bone()) return client.feed.compare(frame.compare_bone());
    if (!frame.has_operator_input()) return WireError{"it sent a frame without a body that is known"};
    const auto intent = intent_from(frame.operator_input(), client.burr_count);
    if (const auto* error = std::get_if<WireError>(&intent)) return *error;
    if (client.seat != nullptr) client.seat->take_input(client.id, std::get<OperatorIntent>(intent), now);
    return std::nullopt;
}

}  // namespace osteomill
