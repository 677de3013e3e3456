// Drawing state of a session that is stepped from Python: to the bit that of its recording.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "python/module/stepped_session.h"
#include "render_client/dataset/imaged_session.h"

namespace osteomill::python {

class DrawnLiveSession final : public ImagedSession {
  public:
    /// At the present instant of `session`, whose `busy` the caller holds, here and in every later call with
    /// it.
    explicit DrawnLiveSession(const SteppedSession& session);

    /// Goes to the present instant of `session`, which may be another one of the same bone: one that began
    /// anew, or a copy. Throws std::invalid_argument for a session of another bone, other tissues or other
    /// burrs.
    void go_to(const SteppedSession& session);

    double time_s() const override { return tool_.time_s; }
    const SessionInfo& session() const override { return info_; }
    const Bone& bone() const override { return stepped_->bone(); }
    const ToolState* tool() const override { return &tool_; }
    std::span<const Structure> structures() const override { return structures_; }
    const std::optional<Viewpoint>& view() const override { return nowhere_; }
    std::vector<BrickChange> take_changes() override;

  private:
    const SteppedSession* stepped_;  // as long as somebody draws
    std::shared_ptr<const LoadedCase> case_;
    SessionInfo info_;
    std::vector<Structure> structures_;
    ToolState tool_;
    Bone seen_;  // the bone as of the last take_changes()
    std::optional<Viewpoint> nowhere_{};
};

}  // namespace osteomill::python
