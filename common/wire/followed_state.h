// A state frame, applied to a replica of the bone that is kept equal to the server's.
#pragma once

#include <variant>

#include "common/wire/bone_replica.h"
#include "common/wire/session_receiver.h"
#include "common/wire/wire_error.h"

namespace osteomill {

/// The result of checking a replica against a frame's checksum.
enum class ReplicaCheck {
    none,     ///< the frame stated none
    equal,    ///< the replica has it
    differs,  ///< the replica has another
};

struct FollowedState {
    ReplicaCheck check = ReplicaCheck::none;
    /// A change raised a fraction, which milling cannot: the replica had lost bone, and has it again. Those
    /// that restore bone are no such changes.
    bool has_regained_bone = false;
};

/// After an error part of the changes may have been applied: a fresh bone is needed.
std::variant<FollowedState, WireError> follow(const StateArrived& arrived, BoneReplica& replica);

}  // namespace osteomill
