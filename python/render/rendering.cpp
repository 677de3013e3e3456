#include "python/render/rendering.h"

#include <utility>

#include "python/render/current_context.h"
#include "render_client/dataset/dataset_index.h"

namespace osteomill::python {

Rendering::Rendering(std::filesystem::path recording, DatasetContents contents) {
    const CurrentContext current(context_);
    gl::require_opengl_3_3();
    frames_.emplace(std::move(recording), std::move(contents),
                    [this](const ImagedSession& session) { sessions_.push_back(session_json(session)); });
}

Rendering::~Rendering() {
    const CurrentContext current(context_);
    frames_.reset();
}

std::optional<Rendering::Frame> Rendering::next(const std::function<bool()>& stop_requested) {
    const std::scoped_lock held(busy_);
    const CurrentContext current(context_);
    auto drawn = frames_->next(stop_requested);
    if (!drawn) return std::nullopt;
    Frame frame{.drawn = *std::move(drawn), .instant = {}, .views = {}};
    frame.instant = instant_json(frame.drawn, frames_->session());
    for (std::size_t i = 0; i < frame.drawn.images.size(); ++i)
        frame.views.push_back(view_json(frame.drawn, i, cameras()[i]));
    return frame;
}

nlohmann::ordered_json Rendering::sessions() {
    const std::scoped_lock held(busy_);
    return sessions_;
}

}  // namespace osteomill::python
