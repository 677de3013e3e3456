// Events that the receiving thread hands to the UI thread, in the order in which it came.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/wire/session_receiver.h"
#include "render_client/link/session_source.h"

namespace osteomill {

/// A server sent its hello: events of an earlier one no longer count.
struct SessionBegan {
    SessionInfo info;
    std::uint64_t number = 0;  ///< counted from 1
};

/// The link stands otherwise than before.
struct StatusChanged {
    LinkStatus status = LinkStatus::connecting;
    std::string line{};
};

using LinkEvent =
    std::variant<SessionBegan, BoneArrived, StateArrived, CtPieceArrived, StructureArrived, StatusChanged>;

}  // namespace osteomill
