#include "python/render/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "python/render/current_context.h"
#include "render_client/dataset/dataset_frames.h"
#include "render_client/dataset/dataset_index.h"

namespace osteomill::python {

namespace {

DatasetContents checked(DatasetContents contents) {
    for (const DatasetCamera& camera : contents.cameras)
        if (camera.follows_trainee)
            throw std::invalid_argument(fmt::format(
                "cameras: nobody looks at a session in Python, so that \"{}\" has nobody to follow; give it "
                "eye_mm and target_mm",
                camera.name));
    return contents;
}

}  // namespace

LiveView::LiveView(const SteppedSession& session, DatasetContents contents)
    : contents_(checked(std::move(contents))), session_(session), json_(session_json(session_)) {
    const CurrentContext current(context_);
    gl::require_opengl_3_3();
    images_.emplace(session_, contents_.cameras, contents_.look, contents_.limits);
}

LiveView::~LiveView() {
    const CurrentContext current(context_);
    images_.reset();
}

Rendering::Frame LiveView::draw(const SteppedSession& session) {
    const std::scoped_lock held(busy_);
    session_.go_to(session);
    const CurrentContext current(context_);
    images_->follow();
    Rendering::Frame frame{
        .drawn = draw_frame(*images_, contents_, count_++, session_), .instant = {}, .views = {}};
    frame.instant = instant_json(frame.drawn, session_);
    for (std::size_t i = 0; i < frame.drawn.images.size(); ++i)
        frame.views.push_back(view_json(frame.drawn, i, cameras()[i]));
    return frame;
}

}  // namespace osteomill::python
