// A session that is stepped from Python, as it is drawn while it goes on: to the bit as its recording would
// be.
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
    /// At the instant where `session` is, whose `busy` the caller holds, here and whenever this is asked of
    /// it.
    explicit DrawnLiveSession(const SteppedSession& session);

    /// To the instant where `session` is, which may be another of the same bone: one that began anew, or a
    /// copy. Throws std::invalid_argument for one of another bone, other tissues or other burrs.
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
