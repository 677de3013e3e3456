#include "python/render/rendering.h"

#include <utility>

#include "render_client/dataset/dataset_index.h"

namespace osteomill::python {

namespace {

/// Whoever draws next may be on another thread.
class Current {
  public:
    explicit Current(const gl::OffscreenContext& context) : context_(context) { context_.make_current(); }
    ~Current() { context_.release(); }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

  private:
    const gl::OffscreenContext& context_;
};

}  // namespace

Rendering::Rendering(std::filesystem::path recording, DatasetContents contents) {
    const Current current(context_);
    gl::require_opengl_3_3();
    frames_.emplace(std::move(recording), std::move(contents),
                    [this](const Playhead& playhead) { sessions_.push_back(session_json(playhead)); });
}

Rendering::~Rendering() {
    const Current current(context_);
    frames_.reset();
}

std::optional<Rendering::Frame> Rendering::next(const std::function<bool()>& stop_requested) {
    const std::scoped_lock held(busy_);
    const Current current(context_);
    auto drawn = frames_->next(stop_requested);
    if (!drawn) return std::nullopt;
    Frame frame{.drawn = *std::move(drawn), .instant = {}, .views = {}};
    frame.instant = instant_json(frame.drawn, frames_->playhead());
    for (std::size_t i = 0; i < frame.drawn.images.size(); ++i)
        frame.views.push_back(view_json(frame.drawn, i, cameras()[i]));
    return frame;
}

nlohmann::ordered_json Rendering::sessions() {
    const std::scoped_lock held(busy_);
    return sessions_;
}

}  // namespace osteomill::python
