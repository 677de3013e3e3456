// Pictures of live sessions, one after the other, in the caller's process: textures of one bone, which follow
// the milling, and an OpenGL context of their own, with which any thread may draw.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "python/module/stepped_session.h"
#include "python/render/rendering.h"
#include "render_client/dataset/dataset_contents.h"
#include "render_client/dataset/imaged_session.h"
#include "render_client/dataset/session_images.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill::python {

/// Drawing state of a session that is stepped from Python: to the bit that of its recording.
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

class LiveView {
  public:
    /// The first view is that of `session`. Throws gl::NoOpenGl; std::runtime_error for a bone that cannot be
    /// drawn; std::invalid_argument for a camera that follows a trainee: a live session has no viewpoint. The
    /// caller holds the session's `busy`, here and in draw().
    LiveView(const SteppedSession& session, DatasetContents contents);
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    /// The present frame of a session. Throws as DrawnLiveSession::go_to. One thread at a time; another
    /// waits.
    Rendering::Frame draw(const SteppedSession& session);

    /// The session's entry in the index of an image set.
    const nlohmann::ordered_json& session() const { return json_; }
    std::span<const DatasetCamera> cameras() const { return contents_.cameras; }
    const DatasetImages& images() const { return contents_.images; }

  private:
    DatasetContents contents_;
    std::mutex busy_;
    gl::OffscreenContext context_;
    DrawnLiveSession session_;
    nlohmann::ordered_json json_;
    std::size_t count_ = 0;
    std::optional<SessionImages> images_;
};

}  // namespace osteomill::python
