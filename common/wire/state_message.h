// A session's state, decoded from a state frame; packed_changes.h decodes the frame's changes of the bone.
#pragma once

#include <cstddef>
#include <variant>

#include "common/scene/session_state.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// Refuses as tool_from, control_events_from, structure_distances_from and viewpoint_from do, for so many
/// burrs and tissues.
std::variant<SessionState, WireError> session_state_from(const v2::StateFrame& message,
                                                         std::size_t burr_count, std::size_t tissue_count);

}  // namespace osteomill
