// Source that a streaming server shows: a session that is going on, or a recording of one.
#pragma once

#include <cstddef>
#include <memory>

#include "common/bone/ct_volume.h"
#include "common/scene/session_control.h"
#include "common/scene/session_state.h"
#include "common/wire/bone_replica.h"

namespace osteomill {

class StreamSource {
  public:
    virtual ~StreamSource() = default;

    /// Once a frame, on the streaming server's thread: writes into the mirror what has changed since the last
    /// call, and says all else that a frame tells. `viewers`: clients that look on.
    virtual SessionState update(BoneReplica& mirror, std::size_t viewers) = 0;

    /// The CT for people to look at, as soon as it is ready: the first call has it made. Nothing where there
    /// is none.
    virtual std::shared_ptr<const CtVolume> ct() { return nullptr; }
    /// Between two updates: somebody who may asks for it. What comes of it is an event.
    virtual void control(const SessionControl&) {}
};

}  // namespace osteomill
