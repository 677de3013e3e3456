// Controls of a session, their outcomes and the controls possible now, in and out of messages.
#pragma once

#include <variant>
#include <vector>

#include "common/session/session_control.h"
#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::SessionControl to_message(const SessionControl& control);
v2::SessionEvent to_message(const ControlEvent& event);
v2::SessionStatus to_message(const SessionStatus& status);

/// Refuses an action that this program does not know and a text that is too long. The text becomes one
/// printable line.
std::variant<SessionControl, WireError> session_control_from(const v2::SessionControl& message);

/// Refuses a time that is not finite. An action that only a newer server knows is `none`.
std::variant<std::vector<ControlEvent>, WireError> control_events_from(
    const google::protobuf::RepeatedPtrField<v2::SessionEvent>& messages);

SessionStatus session_status_from(const v2::SessionStatus& message);

}  // namespace osteomill
