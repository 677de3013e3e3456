// What a streaming server shows: a session that is going on, or a recording of one.
#pragma once

#include <cstddef>

#include "common/scene/tool_state.h"
#include "common/wire/bone_replica.h"

namespace osteomill {

class StreamSource {
  public:
    virtual ~StreamSource() = default;

    /// Once a frame, on the streaming server's thread: writes into the mirror what has changed since the last
    /// call, and says where the tool is now. `viewers`: clients that look on.
    virtual ToolState update(BoneReplica& mirror, std::size_t viewers) = 0;
};

}  // namespace osteomill
