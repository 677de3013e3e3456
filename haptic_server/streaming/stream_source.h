// Source of a streaming server: a running session, or a recording.
#pragma once

#include <cstddef>
#include <memory>

#include "common/bone/ct_volume.h"
#include "common/session/session_control.h"
#include "common/session/session_state.h"
#include "common/wire/bone_replica.h"

namespace osteomill {

class StreamSource {
  public:
    virtual ~StreamSource() = default;

    /// Once a frame, on the streaming server's thread: applies the changes since the last call to the mirror,
    /// and returns the rest of the frame. `viewers`: number of watching clients.
    virtual SessionState update(BoneReplica& mirror, std::size_t viewers) = 0;

    /// The CT, to be shown, as soon as it is ready: the first call has it made. Nothing if there
    /// is none.
    virtual std::shared_ptr<const CtVolume> ct() { return nullptr; }
    /// Between two updates: a request by a client with the right to it. The outcome is an event.
    virtual void control(const SessionControl&) {}
};

}  // namespace osteomill
