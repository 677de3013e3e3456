// What a streaming server shows: a session that is going on, or a recording of one.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "common/bone/ct_volume.h"
#include "common/scene/session_control.h"
#include "common/scene/structure_distance.h"
#include "common/scene/tool_state.h"
#include "common/wire/bone_replica.h"

namespace osteomill {

class StreamSource {
  public:
    virtual ~StreamSource() = default;

    /// Once a frame, on the streaming server's thread: writes into the mirror what has changed since the last
    /// call, and says where the tool is now. `viewers`: clients that look on.
    virtual ToolState update(BoneReplica& mirror, std::size_t viewers) = 0;

    // After update(): what was done to the session since the last time, and what can be done now. As long as
    // nothing can be, nothing has to be said.
    virtual std::vector<ControlEvent> take_events() { return {}; }
    virtual SessionStatus status() const { return {}; }
    /// After update(): how far the burr is from the protected structures that are near or were touched.
    virtual std::span<const StructureDistance> distances() const { return {}; }
    /// The CT for people to look at, as soon as it is ready: the first call has it made. Nothing where there
    /// is none.
    virtual std::shared_ptr<const CtVolume> ct() { return nullptr; }
    /// Between two updates: somebody who may asks for it. What comes of it is an event.
    virtual void control(const SessionControl&) {}
};

}  // namespace osteomill
