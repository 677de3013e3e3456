// A session at an instant, as image sets see it: its description, its bone, its tool. One is recorded,
// another live.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/recording/playhead.h"
#include "common/session/tool_state.h"
#include "common/session/viewpoint.h"
#include "common/wire/session_info.h"

namespace osteomill {

class ImagedSession {
  public:
    virtual ~ImagedSession() = default;

    virtual double time_s() const = 0;
    virtual const SessionInfo& session() const = 0;
    virtual const Bone& bone() const = 0;
    /// Nothing before there is one.
    virtual const ToolState* tool() const = 0;
    virtual std::span<const Structure> structures() const = 0;
    /// The viewpoint of the trainee, if it is known.
    virtual const std::optional<Viewpoint>& view() const = 0;
    /// Changes of the bone since the last call.
    virtual std::vector<BrickChange> take_changes() = 0;
};

/// At the place of a playhead, which outlives it.
class DrawnRecording final : public ImagedSession {
  public:
    explicit DrawnRecording(Playhead& playhead) : playhead_(playhead) {}

    double time_s() const override { return playhead_.time_s(); }
    const SessionInfo& session() const override { return playhead_.session(); }
    const Bone& bone() const override { return playhead_.bone(); }
    const ToolState* tool() const override { return playhead_.tool(); }
    std::span<const Structure> structures() const override { return playhead_.structures(); }
    const std::optional<Viewpoint>& view() const override { return playhead_.state().view; }
    std::vector<BrickChange> take_changes() override { return playhead_.take_changes(); }

  private:
    Playhead& playhead_;
};

}  // namespace osteomill
