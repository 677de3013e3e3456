// What the receiving thread hands to the UI thread, in the order in which it came.
#pragma once

#include <string>
#include <variant>

#include "common/bone/bone.h"
#include "common/wire/running_checksum.h"
#include "osteomill/v1/session.pb.h"
#include "render_client/link/bone_link.h"

namespace osteomill {

/// A server said hello: what came from the one before is history.
struct SessionBegan {
    SessionInfo info;
};

/// A snapshot is complete. Its checksum terms come with it, so that the UI thread need not hash all of it.
struct BoneArrived {
    Bone bone;
    RunningChecksum checksum;
};

/// A state frame, as it came; checked when it is applied.
struct StateArrived {
    v1::StateFrame frame;
};

/// The link stands otherwise than before.
struct StatusChanged {
    LinkStatus status = LinkStatus::connecting;
    std::string line{};
};

using LinkEvent = std::variant<SessionBegan, BoneArrived, StateArrived, StatusChanged>;

}  // namespace osteomill
