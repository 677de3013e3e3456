// Pictures of live sessions, one after the other, in the caller's process: textures of one bone, which follow
// the milling, and an OpenGL context of their own, with which any thread may draw.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "python/render/drawn_live_session.h"
#include "python/render/rendering.h"
#include "render_client/dataset/dataset_contents.h"
#include "render_client/dataset/session_images.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill::python {

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
